//! Pictures of cages in parts.

use osculate_cage::Cage;

use super::Parts;
use crate::canvas::Canvas;
use crate::{Engine, EngineError, Picture, RenderDesc, Shade, Surface};

impl Parts<'_> {
    /// Draws the parts, one after the other, into one picture: bit for bit that of the whole cage. What lies upon the surface, lines and the cage, is drawn when
    /// all of the surface is there, and so needs the parts again.
    ///
    /// `dress` is given the surface of each part, with the part as a cage, before it is drawn: it may add maps.
    ///
    /// # Errors
    /// As [`crate::render`] and [`Self::for_each`]; and whatever `dress` returns.
    pub fn render<E: From<EngineError>>(
        &mut self,
        desc: &RenderDesc,
        mut dress: impl FnMut(&Surface, &Cage) -> Result<Surface, E>,
    ) -> Result<Picture, E> {
        if desc.shade == Shade::Difference {
            return Err(EngineError::OneSurface.into());
        }
        let engine: Engine = self.engine.clone();
        let mut canvas = Canvas::new(&engine, desc)?;
        for layer in canvas.layers() {
            self.for_each(|part| {
                let surface = dress(part.surface(), part.cage().cage())?;
                canvas.prepare(&[&surface])?;
                Ok::<(), E>(canvas.add_layer(&surface, layer)?)
            })?;
        }
        Ok(canvas.finish()?)
    }
}
