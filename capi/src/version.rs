//! Which interface this is.

/// First number of the version of this interface; `mufasa_version` says that of the library.
pub const MUFASA_VERSION_MAJOR: u32 = 0;
/// Second number.
pub const MUFASA_VERSION_MINOR: u32 = 2;
/// Third number.
pub const MUFASA_VERSION_PATCH: u32 = 0;

/// The version of the library: 1000000 times the first number, 1000 times the second, and the third. Header
/// and library belong together only when these are those of the header.
#[unsafe(no_mangle)]
pub extern "C" fn mufasa_version() -> u32 {
    const { MUFASA_VERSION_MAJOR * 1_000_000 + MUFASA_VERSION_MINOR * 1_000 + MUFASA_VERSION_PATCH }
}

#[cfg(test)]
mod tests {
    use super::{MUFASA_VERSION_MAJOR, MUFASA_VERSION_MINOR, MUFASA_VERSION_PATCH};

    #[test]
    fn the_version_is_that_of_the_package() {
        let version =
            format!("{MUFASA_VERSION_MAJOR}.{MUFASA_VERSION_MINOR}.{MUFASA_VERSION_PATCH}");
        assert_eq!(version, env!("CARGO_PKG_VERSION"));
    }
}
