//! Values of limits: numbers, or formulas of the car and its run.
//!
//! | formula | limit | keys |
//! |---|---|---|
//! | `nadal` | (tan δ - μ)/(1 + μ tan δ), δ the least flange angle of the car's wheels | `friction`: μ; left out: the greatest at these flanges |
//! | `net_axle` | base + load/Va, Va the greatest static axle load | `base`, `load` |
//! | `prudhomme` | share (base + P0/3), P0 the least static axle load | `share`, `base` |
//! | `wheel_load` | base + Q0, at most `most`; Q0 the least static wheel load | `base`, `most` |
//! | `table` | over another measure of the same run, straight between points, constant beyond | `by`, `points` |
//!
//! Sources: Nadal 1896; net axle: 49 CFR 213.333 (2013); Prud'homme 1967 and wheel load as EN 14363 has them
//! (remembered). Where axles or wheels carry different loads, the one with the strictest limit counts for
//! all: a car is never judged better than axle by axle.

use quantity::{Kind, SixDigits};
use wheelrail::climb::nadal;

use crate::car::worst::Worst;

/// What is known of a car and its run, SI, by the names of measures.
pub type Known<'k> = &'k dyn Fn(&str) -> Option<f64>;

/// The value of a limit.
#[derive(Clone, Debug, PartialEq)]
pub enum LimitValue {
    /// In the unit of the limit.
    Number(f64),
    /// A formula.
    Formula(Formula),
}

/// A limit that depends on the car or its run, SI.
#[derive(Clone, Debug, PartialEq)]
pub enum Formula {
    /// Nadal's.
    Nadal {
        /// The coefficient of friction; `None`: that of the case.
        friction: Option<f64>,
    },
    /// Of the net lateral force of an axle over its static load.
    NetAxle {
        /// The constant part.
        base: f64,
        /// The load over that of the axle, N.
        load: f64,
    },
    /// Prud'homme's, of the lateral force of an axle.
    Prudhomme {
        /// The factor of all of it.
        share: f64,
        /// The constant part, N.
        base: f64,
    },
    /// Of a wheel's vertical force.
    WheelLoad {
        /// The part beyond the static load, N.
        base: f64,
        /// The greatest value, N.
        most: f64,
    },
    /// Over another measure.
    Table {
        /// That measure.
        by: &'static Worst,
        /// Its values, rising, and the limits there.
        points: Vec<[f64; 2]>,
    },
}

impl Formula {
    /// Returns the limit, SI; `None` where something that it needs is not known, or it is not above zero.
    #[must_use]
    pub fn value(&self, known: Known<'_>) -> Option<f64> {
        let own = |name: &str| known(name).filter(|value| value.is_finite());
        let value = match self {
            Self::Nadal { friction } => {
                let friction = friction.or_else(|| own("flange_friction"))?;
                nadal(own("least_flange_angle")?, friction)
            }
            Self::NetAxle { base, load } => base + load / own("greatest_static_axle_load")?,
            Self::Prudhomme { share, base } => share * (base + own("least_static_axle_load")? / 3.0),
            Self::WheelLoad { base, most } => (base + own("least_static_wheel_load")?).min(*most),
            Self::Table { by, points } => at(points, own(by.name)?)?,
        };
        Some(value).filter(|own| own.is_finite() && *own > 0.0)
    }

    /// Returns it in words; `unit` is that of its value, and `si` that unit in SI.
    #[must_use]
    pub fn words(&self, (unit, si): (&str, f64)) -> String {
        let of = |value: f64| match unit {
            "" => SixDigits(value).to_string(),
            unit => format!("{} {unit}", SixDigits(value / si)),
        };
        match self {
            Self::Nadal { friction: Some(mu) } => {
                format!("(tan d - {mu})/(1 + {mu} tan d), d the flange angle")
            }
            Self::Nadal { friction: None } => {
                "(tan d - mu)/(1 + mu tan d), d the flange angle, mu the friction there".to_owned()
            }
            Self::NetAxle { base, load } => {
                let kips = SixDigits(load / (1e3 * crate::car::checks::POUND_FORCE));
                format!("{base} + {kips} kip/static axle load")
            }
            Self::Prudhomme { share, base } => {
                format!("{share} ({} + a third of the static axle load)", of(*base))
            }
            Self::WheelLoad { base, most } => {
                format!("{} + static wheel load, at most {}", of(*base), of(*most))
            }
            Self::Table { by, .. } => format!("by a table over {}", by.name),
        }
    }
}

/// Returns the value of a table at a place.
fn at(points: &[[f64; 2]], place: f64) -> Option<f64> {
    let above = points.partition_point(|[x, _]| *x <= place);
    let (before, after) = (above.checked_sub(1).map(|own| points[own]), points.get(above));
    match (before, after) {
        (Some([x, y]), Some([x1, y1])) => Some(y + (y1 - y) * (place - x) / (x1 - x)),
        (Some([_, y]), None) => Some(y),
        (None, Some([_, y])) => Some(*y),
        (None, None) => None,
    }
}

/// The kind of a formula's value: pure numbers of ratios, forces of forces.
pub(super) fn fits(name: &str, kind: Kind) -> bool {
    match name {
        "nadal" | "net_axle" => kind == Kind::Dimensionless,
        "prudhomme" | "wheel_load" => kind == Kind::Force,
        _ => true,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const POUND: f64 = crate::car::checks::POUND_FORCE;

    fn car(name: &str) -> Option<f64> {
        Some(match name {
            "least_flange_angle" => 75.0_f64.to_radians(),
            "flange_friction" => 0.4,
            "greatest_static_axle_load" => 65.75e3 * POUND,
            "least_static_axle_load" => 225e3,
            "least_static_wheel_load" => 112.5e3,
            "climb_angle_of_attack" => 7.5e-3,
            _ => return None,
        })
    }

    #[test]
    fn analytic_formulas_of_the_rules() {
        let of = |formula: Formula| formula.value(&car).unwrap();
        let near = |a: f64, b: f64| assert!((a - b).abs() < 1e-4 * b, "{a} {b}");
        // tan 75° = 2 + √3.
        let tan = 2.0 + 3.0_f64.sqrt();
        near(
            of(Formula::Nadal { friction: Some(0.5) }),
            (tan - 0.5) / (1.0 + 0.5 * tan),
        );
        near(of(Formula::Nadal { friction: Some(0.5) }), 1.1276);
        near(
            of(Formula::Nadal { friction: None }),
            (tan - 0.4) / (1.0 + 0.4 * tan),
        );
        near(
            of(Formula::NetAxle {
                base: 0.4,
                load: 5e3 * POUND,
            }),
            0.4 + 5.0 / 65.75,
        );
        near(
            of(Formula::Prudhomme {
                share: 0.85,
                base: 10e3,
            }),
            0.85 * 85e3,
        );
        near(
            of(Formula::WheelLoad {
                base: 90e3,
                most: 200e3,
            }),
            200e3,
        );
        near(
            of(Formula::WheelLoad {
                base: 80e3,
                most: 200e3,
            }),
            192.5e3,
        );
        let by = Worst::named("l_over_v_time").unwrap();
        let table = Formula::Table {
            by,
            points: vec![[0.0, 4.0], [1.0, 2.0]],
        };
        near(table.value(&|_| Some(0.25)).unwrap(), 3.5);
        near(table.value(&|_| Some(-1.0)).unwrap(), 4.0);
        near(table.value(&|_| Some(7.0)).unwrap(), 2.0);
    }

    #[test]
    fn limits_of_formulas_without_what_they_need_are_none() {
        assert_eq!(Formula::Nadal { friction: None }.value(&|_| None), None);
        assert_eq!(Formula::Nadal { friction: None }.value(&|_| Some(f64::NAN)), None);
    }
}
