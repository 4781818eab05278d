//! Readers: small files of our own, broken files, and the shared recordings where they are.

mod readers {
    pub mod broken;
    pub mod corridors;
    pub mod crossing;
    pub mod files;
    pub mod history;
    pub mod injected;
    pub mod left_out;
    pub mod objects;
    pub mod piped;
    pub mod shared;
    pub mod small;
    pub mod vehicle;
}
