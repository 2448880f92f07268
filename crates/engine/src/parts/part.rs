//! One part of a cage on the device.

use osculate_cage::CagePart;
use osculate_subdiv::{Place, SurfacePlan, WholeNames};

use crate::{CapturedVertex, Engine, EngineError, Surface, SurfaceDesc, VertexKey};

/// What identifies a vertex of the tessellated surface of a cage in parts. Equal keys mean the same point of the surface, whichever patch of whichever part drew it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum WholeKey {
    /// A vertex record, by its name in the whole cage.
    Vertex(u64),
    /// An edge record, by its name in the whole cage, and the bits of its parameter.
    Edge(u64, u32),
    /// A final face of the whole cage and the bits of its parameters.
    Inside(u64, u32, u32),
}

/// A part of a cage: a surface that draws the faces that are its own.
pub struct Part {
    surface: Surface,
    cage: CagePart,
    names: WholeNames,
    number: usize,
    count: usize,
}

impl Part {
    /// Builds the tables of a part, uploads them, and computes all points and records.
    ///
    /// # Errors
    /// As [`Surface::new`]; there is nothing to draw if no own face is drawn.
    pub fn new(engine: &Engine, cage: CagePart, desc: &SurfaceDesc) -> Result<Self, EngineError> {
        let plan = SurfacePlan::build_part(&cage, &desc.plan())?;
        let names = WholeNames::new(&plan, &cage);
        let surface = Surface::from_plan(engine, cage.cage(), plan, |face| cage.is_own(face))?;
        Ok(Self { surface, cage, names, number: 0, count: 1 })
    }

    pub(super) fn numbered(self, number: usize, count: usize) -> Self {
        Self { number, count, ..self }
    }

    /// The surface.
    pub fn surface(&self) -> &Surface {
        &self.surface
    }

    /// Faces and vertices, and which they are in the whole cage.
    pub fn cage(&self) -> &CagePart {
        &self.cage
    }

    /// What the plan's records are called in the whole cage.
    pub fn names(&self) -> &WholeNames {
        &self.names
    }

    /// Which of the parts it is, from 0, and how many there are.
    pub fn number(&self) -> (usize, usize) {
        (self.number, self.count)
    }

    /// The key of a captured vertex.
    ///
    /// # Panics
    /// If the vertex is not of this part.
    pub fn key(&self, vertex: &CapturedVertex) -> WholeKey {
        let plan = self.surface.plan();
        match VertexKey::of(plan, vertex) {
            VertexKey::Vertex(record) => WholeKey::Vertex(self.names.vertices[record as usize]),
            VertexKey::Edge(record, t) => WholeKey::Edge(self.names.edges[record as usize], t),
            VertexKey::Inside(patch, u, v) => WholeKey::Inside(plan.whole_face(&self.cage, patch), u, v),
        }
    }

    /// Where a point of a patch lies on the whole cage.
    ///
    /// # Panics
    /// If there is no such patch.
    pub fn place(&self, patch: u32, uv: [f64; 2]) -> Place {
        let mut place = self.surface.place(patch, uv);
        place.sub_face.face = self.cage.faces()[place.sub_face.face as usize];
        place
    }
}
