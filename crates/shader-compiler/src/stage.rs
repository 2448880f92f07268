//! Shader stages, told by file name extension.

use crate::CompileError;
use shaderc::ShaderKind;

/// A programmable stage of the pipelines that this project builds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Stage {
    /// `.vert`
    Vertex,
    /// `.tesc`
    TessellationControl,
    /// `.tese`
    TessellationEvaluation,
    /// `.frag`
    Fragment,
    /// `.comp`
    Compute,
}

impl Stage {
    /// File name extensions, without the dot, and their stages.
    pub const EXTENSIONS: [(&'static str, Self); 5] = [
        ("vert", Self::Vertex),
        ("tesc", Self::TessellationControl),
        ("tese", Self::TessellationEvaluation),
        ("frag", Self::Fragment),
        ("comp", Self::Compute),
    ];

    /// The stage that the extension of `path` stands for.
    pub fn of_path(path: &str) -> Result<Self, CompileError> {
        let extension = path.rsplit_once('.').map_or("", |(_, extension)| extension);
        Self::EXTENSIONS
            .iter()
            .find(|(known, _)| *known == extension)
            .map(|&(_, stage)| stage)
            .ok_or_else(|| CompileError::UnknownStage { name: path.to_owned() })
    }

    pub(crate) fn kind(self) -> ShaderKind {
        match self {
            Self::Vertex => ShaderKind::Vertex,
            Self::TessellationControl => ShaderKind::TessControl,
            Self::TessellationEvaluation => ShaderKind::TessEvaluation,
            Self::Fragment => ShaderKind::Fragment,
            Self::Compute => ShaderKind::Compute,
        }
    }
}
