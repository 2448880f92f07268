//! GLSL to SPIR-V through shaderc, with includes and errors that name file and line.
