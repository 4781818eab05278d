//! All tests of the package, in one program: each links everything.

mod body;
mod common;
mod drivers;
mod experiment;
mod falsify;
mod ftti;
#[path = "loop/mod.rs"]
mod in_the_loop;
mod own_plans;
mod path;
mod pinned;
mod services;
mod town;
mod traffic;
mod ulm;
