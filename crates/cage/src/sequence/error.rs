//! What can be wrong with a sequence of frames.

/// Why files or samples are not the frames of one cage.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum SequenceError {
    /// A pattern with several places for the number.
    #[error("a pattern with several places for the number of the frame; there must be one, such as #### or %04d")]
    SeveralPlaces,
    /// There is no file that a pattern describes.
    #[error("there is no file like that; #### stands for numbers with at least four digits, %d for any number")]
    NoFiles,
    /// The numbers have a gap.
    #[error("frame {number} is missing, but there are frames {first} to {last}; all between them must be there")]
    Missing {
        /// The first number that is missing.
        number: u64,
        /// The first number that is there.
        first: u64,
        /// The last number that is there.
        last: u64,
    },
    /// A frame that does not exist.
    #[error("there is no frame {frame}; the frames count from 0, and there are {count}")]
    NoSuchFrame {
        /// The number that was asked for.
        frame: usize,
        /// How many there are.
        count: usize,
    },
    /// A frame with other vertices than the first.
    #[error("{found} vertices, but the first frame ({first}) has {due}; all frames must have the same faces")]
    Vertices {
        /// How many vertices there are.
        found: usize,
        /// How many there are in the first frame.
        due: usize,
        /// The first frame.
        first: String,
    },
    /// A frame with more or fewer faces than the first.
    #[error("{found} faces, but the first frame ({first}) has {due}; all frames must have the same faces")]
    Faces {
        /// How many faces there are.
        found: usize,
        /// How many there are in the first frame.
        due: usize,
        /// The first frame.
        first: String,
    },
    /// A face with other corners than in the first frame.
    #[error("face {face} (faces count from 0) has other corners than in the first frame ({first})")]
    Face {
        /// The first face that differs.
        face: usize,
        /// The first frame.
        first: String,
    },
    /// The file was changed while it was in use.
    #[error("the file has changed since it was opened; open it again")]
    Changed,
}
