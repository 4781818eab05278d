//! Readers: small files of our own, broken files, and the shared recordings where they are.

mod broken;
mod corridors;
mod crossing;
mod files;
mod history;
mod injected;
mod left_out;
mod objects;
mod piped;
mod shared;
mod small;
mod vehicle;
