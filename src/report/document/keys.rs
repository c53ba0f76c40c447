//! How results are told: each key once, with its type and what stands there.

/// A part of a result: a type with keys that is written and read, and how it is made of what is given. Keys behind `or nothing`
/// are left out where there is nothing to say.
macro_rules! keys {
    (
        $(#[$about:meta])*
        $name:ident($($given:ident: $of:ty),*) {
            $($(#[$what:meta])* $key:ident: $type:ty = $value:expr,)*
        }
        $(or nothing {
            $($(#[$may_be:meta])* $may:ident: $may_type:ty = $may_value:expr,)*
        })?
    ) => {
        $(#[$about])*
        #[derive(Debug, Clone, PartialEq, serde::Serialize, serde::Deserialize)]
        pub struct $name {
            $($(#[$what])* pub $key: $type,)*
            $($(
                $(#[$may_be])*
                #[serde(default, skip_serializing_if = "crate::report::document::is_nothing")]
                pub $may: $may_type,
            )*)?
        }

        impl $name {
            /// What there is to say of what is given.
            pub fn new($($given: $of),*) -> Self {
                $name { $($key: $value,)* $($($may: $may_value,)*)? }
            }
        }
    };
}
