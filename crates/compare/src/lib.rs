//! Perceptual comparison of pictures by FLIP, for golden images and for users.
