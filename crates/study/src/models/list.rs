//! What the list of models declares: cases and summaries of whatever model.

/// Declares [`AnyCase`], made of the case of each model, and `each_case!`.
macro_rules! any_case {
    ($d:tt $($(#[$doc:meta])* $model:ident($case:ty) = $name:literal, $own:ident;)+) => {
        /// A case of any model, which its copies share.
        #[derive(Clone, Debug)]
        pub enum AnyCase {
            $($(#[$doc])* $model(Arc<$case>),)+
        }

        impl AnyCase {
            /// Returns the name of its model, as in [`MODELS`].
            #[must_use]
            pub fn model(&self) -> &'static str {
                match self {
                    $(Self::$model(_) => $name,)+
                }
            }

            $(
                /// Returns the case of this model, if it is one.
                #[must_use]
                pub fn $own(&self) -> Option<&Arc<$case>> {
                    match self {
                        Self::$model(case) => Some(case),
                        _ => None,
                    }
                }
            )+
        }

        /// Does the same with the case of whatever model: `each_case!(&any, case => case.columns())`.
        #[macro_export]
        macro_rules! each_case {
            ($d any:expr, $d case:ident => $d do:expr) => {
                match $d any {
                    $($crate::models::AnyCase::$model($d case) => $d do,)+
                }
            };
        }

        $(
            impl From<$case> for AnyCase {
                fn from(case: $case) -> Self {
                    Self::$model(Arc::new(case))
                }
            }

            impl From<Arc<$case>> for AnyCase {
                fn from(case: Arc<$case>) -> Self {
                    Self::$model(case)
                }
            }
        )+
    };
}
pub(super) use any_case;

/// Declares [`AnySummary`], made of the summary of each model, and `each_summary!`.
macro_rules! any_summary {
    ($d:tt $($(#[$doc:meta])* $model:ident($summary:ty),)+) => {
        /// The summary of a run of any model.
        #[derive(Clone, Debug, Serialize, Deserialize)]
        pub enum AnySummary {
            $($(#[$doc])* $model(Box<$summary>),)+
        }

        /// Does the same with the summary of whatever model: `each_summary!(&any, own => own.units())`.
        #[macro_export]
        macro_rules! each_summary {
            ($d any:expr, $d own:ident => $d do:expr) => {
                match $d any {
                    $($crate::models::AnySummary::$model($d own) => $d do,)+
                }
            };
        }

        $(
            impl From<$summary> for AnySummary {
                fn from(summary: $summary) -> Self {
                    Self::$model(Box::new(summary))
                }
            }

            impl ModelSummary for $summary {
                fn of(any: &AnySummary) -> Option<&Self> {
                    match any {
                        AnySummary::$model(own) => Some(own),
                        _ => None,
                    }
                }
            }
        )+
    };
}
pub(super) use any_summary;
