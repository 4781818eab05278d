//! What a campaign asks: vectors, and cases generated or of drives, each a question of one line.

pub mod case;
pub mod damage;
pub mod drives;
pub mod generate;
pub mod order;
pub mod question;
pub mod source;
pub mod vectors;
