//! The macro that declares options.

/// Declares a struct of options, and derives its JSON, its schema and its command line from the declaration.
///
/// ```text
/// options! {
///     /// Where to cut.
///     pub struct Cutting under "Where to cut" {
///         /// The price of a seam: 0 cuts wherever that gains anything, a large number never.
///         pub seam_weight: f64 = 1.0, in 0..=1e6, value "W";
///     }
/// }
/// ```
///
/// `under` is the heading of the help. An option without a default is absent, off or empty unless
/// it is given. `in` is its range, `value` the placeholder of its value in the help, and `also` an alias that is not
/// shown. `arg(…)` and `schema(…)` are further attributes for clap and utoipa.
///
/// Three blocks may follow. `files` are options that JSON has like the others, but that the command line reads from
/// files or derives from a file's name: it declares those itself, with [`about`](super::OptionSet::about) as their
/// help. `groups` are sets of options that this one consists of. `untold` fields are not options; code sets them.
#[macro_export]
macro_rules! options {
    (@default) => { Default::default() };
    (@default $default:expr) => { $default };
    (
        $(#[doc = $doc:tt])+
        $(#[derive($Copy:ident)])?
        pub struct $Set:ident $(under $heading:literal)? {
            $(
                $(#[doc = $about:tt])+
                pub $name:ident: $Type:ty $(= $default:expr)? $(, in $low:tt ..= $high:tt)? $(, value $value:literal)?
                    $(, also $known_as:literal)? $(, arg($($arg:tt)*))? $(, schema($($schema:tt)*))?;
            )*
        }
        $(files {
            $(
                $(#[doc = $file_about:tt])+
                pub $file:ident: $File:ty $(= $file_default:expr)? $(, also $also:literal)?;
            )*
        })?
        $(groups {
            $(
                $(#[doc = $group_about:tt])+
                pub $group:ident: $Group:ty;
            )*
        })?
        $(untold {
            $(
                $(#[doc = $untold_about:tt])+
                pub $untold:ident: $Untold:ty;
            )*
        })?
    ) => {
        $(#[doc = $doc])+
        #[derive(Clone, Debug, PartialEq, serde::Serialize $(, $Copy)?)]
        #[cfg_attr(feature = "schema", derive(clap::Args, utoipa::ToSchema))]
        #[serde(default)]
        $(#[cfg_attr(feature = "schema", command(next_help_heading = $heading))])?
        pub struct $Set {
            $(
                $(#[doc = $about])+
                #[cfg_attr(feature = "schema", arg(
                    long
                    $(, default_value = $crate::options::typed::<$Type>(&$default))?
                    $(, value_name = $value)?
                    $(, alias = $known_as)?
                    $(, $($arg)*)?
                ))]
                $(#[cfg_attr(feature = "schema", schema(minimum = $low, maximum = $high))])?
                $(#[cfg_attr(feature = "schema", schema($($schema)*))])?
                pub $name: $Type,
            )*
            $($(
                $(#[doc = $file_about])+
                #[cfg_attr(feature = "schema", arg(skip $(= $file_default)?))]
                pub $file: $File,
            )*)?
            $($(
                $(#[doc = $group_about])+
                #[cfg_attr(feature = "schema", command(flatten))]
                #[serde(flatten)]
                pub $group: $Group,
            )*)?
            $($(
                $(#[doc = $untold_about])+
                #[cfg_attr(feature = "schema", arg(skip))]
                #[serde(skip)]
                pub $untold: $Untold,
            )*)?
        }

        impl Default for $Set {
            fn default() -> Self {
                Self {
                    $($name: $crate::options!(@default $($default)?),)*
                    $($($file: $crate::options!(@default $($file_default)?),)*)?
                    $($($group: Default::default(),)*)?
                    $($($untold: Default::default(),)*)?
                }
            }
        }

        impl $crate::options::OptionSet for $Set {
            fn check_ranges(&self) -> Result<(), String> {
                $($($crate::options::Ranged::check(
                    &self.$name,
                    stringify!($name),
                    f64::from($low),
                    f64::from($high),
                )?;)?)*
                $($($crate::options::OptionSet::check_ranges(&self.$group)?;)*)?
                Ok(())
            }

            fn names() -> Vec<&'static str> {
                let own = [$(stringify!($name),)* $($(stringify!($file),)*)?];
                let groups: [Vec<&'static str>; _] =
                    [$($(<$Group as $crate::options::OptionSet>::names(),)*)?];
                own.into_iter().chain(groups.concat()).collect()
            }

            fn about(name: &str) -> Option<&'static str> {
                match name {
                    $(stringify!($name) => Some(concat!($($about, "\n"),+)),)*
                    $($(stringify!($file) => Some(concat!($($file_about, "\n"),+)),)*)?
                    _ => None,
                }
            }

            fn taken_from(given: &mut $crate::options::Object) -> Result<Self, String> {
                Ok(Self {
                    $($name: $crate::options::taken(
                        given,
                        &[stringify!($name) $(, $known_as)?],
                        $crate::options!(@default $($default)?),
                    )?,)*
                    $($($file: $crate::options::taken(
                        given,
                        &[stringify!($file) $(, $also)?],
                        $crate::options!(@default $($file_default)?),
                    )?,)*)?
                    $($($group: $crate::options::OptionSet::taken_from(given)?,)*)?
                    $($($untold: Default::default(),)*)?
                })
            }
        }

        impl<'de> serde::Deserialize<'de> for $Set {
            fn deserialize<D: serde::Deserializer<'de>>(given: D) -> Result<Self, D::Error> {
                $crate::options::deserialized(given)
            }
        }
    };
}
