//! Enumerations whose values have a name in tables and files, and are written as such.

macro_rules! named {
    ($($(#[$doc:meta])* $name:ident { $($(#[$of:meta])* $value:ident = $word:literal,)* })*) => {$(
        $(#[$doc])*
        #[derive(
            Clone,
            Copy,
            Debug,
            PartialEq,
            Eq,
            PartialOrd,
            Ord,
            serde::Serialize,
            serde::Deserialize,
            schemars::JsonSchema,
        )]
        #[serde(rename_all = "kebab-case")]
        pub enum $name { $($(#[$of])* $value,)* }

        impl $name {
            /// All.
            pub const ALL: [Self; [$($word),*].len()] = [$(Self::$value,)*];

            /// Its name in tables and files.
            pub const fn name(self) -> &'static str {
                match self { $(Self::$value => $word,)* }
            }
        }
    )*};
}
pub(crate) use named;
