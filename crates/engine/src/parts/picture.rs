//! Pictures of cages in parts.

use super::{Part, Parts};
use crate::canvas::Canvas;
use crate::{Engine, EngineError, Picture, RenderDesc, Shade, Surface};

impl Parts<'_> {
    /// Draws the parts, one after the other, into one picture: bit for bit that of the whole cage. What lies upon the surface, lines and the cage, is drawn when
    /// all of the surface is there, and so needs the parts again.
    ///
    /// `dress` gives the surface that is drawn of each part: its own, or that with maps.
    ///
    /// # Errors
    /// As [`crate::render`] and [`Self::for_each`]; and whatever `dress` returns.
    pub fn render<E: From<EngineError>>(
        &mut self,
        desc: &RenderDesc,
        mut dress: impl FnMut(&Part) -> Result<Surface, E>,
    ) -> Result<Picture, E> {
        if desc.shade == Shade::Difference {
            return Err(EngineError::OneSurface.into());
        }
        let engine: Engine = self.engine.clone();
        let mut canvas = Canvas::new(&engine, desc)?;
        for layer in canvas.layers() {
            self.for_each(|part| {
                let surface = dress(part)?;
                canvas.prepare(&[&surface])?;
                Ok::<(), E>(canvas.add_layer(&surface, layer)?)
            })?;
        }
        Ok(canvas.finish()?)
    }
}
