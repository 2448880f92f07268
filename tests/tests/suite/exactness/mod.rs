//! How near the schemes come to the limit surface, and to what each of them promises.

mod biseptic;
mod gregory;
mod judge;
mod sabotage;
mod sides;
mod stam;
