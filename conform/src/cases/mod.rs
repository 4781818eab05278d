//! The cases of a campaign: generated or of drives, each a question of one line.

pub mod damage;
pub mod drives;
pub mod generate;
pub mod question;
pub mod source;
