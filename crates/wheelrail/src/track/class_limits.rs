//! Limits of track geometry by class: 49 CFR Part 213 (United States), subparts C, D and G.
//!
//! Rows whose numbers were read in a source are marked so (November 2026, the rule's text); the others are
//! from memory. Check those against the rule's text before a decision. The edition is that of 1998 as amended
//! in 2013, remembered.
//!
//! **Not covered**: gauge and surface of classes 6 to 9 (213.323, 213.331), runoff at the end of a raise and
//! spirals of limited length (notes of 213.63), cant deficiency (213.57), combined deviations (213.65,
//! 213.332), everything that is not geometry.

const INCH: f64 = 0.0254;
const FOOT: f64 = 0.3048;

/// The number of classes.
pub const CLASSES: usize = 9;
/// The highest class all of whose rows are here.
pub const HIGHEST_COVERED: usize = 5;

/// Origin of a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mark {
    /// Read in the source.
    Read,
    /// From memory.
    Remembered,
}

impl Mark {
    /// Returns it in words.
    #[must_use]
    pub const fn words(self) -> &'static str {
        match self {
            Self::Read => "read",
            Self::Remembered => "remembered",
        }
    }
}

/// A measured quantity that a class limits.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ClassQuantity {
    /// Largest gauge.
    WidestGauge,
    /// Smallest gauge: the limit is the least value.
    NarrowestGauge,
    /// Mid-chord offset of the alignment on tangents, of a chord (m), of either rail.
    TangentAlinement(f64),
    /// Mid-chord offset of the alignment in curves and spirals, of a chord (m), of the outer rail.
    CurveAlinement(f64),
    /// Mid-chord offset of the alignment anywhere, of a chord (m).
    Alinement(f64),
    /// Mid-chord offset of the profile of either rail, of a chord (m).
    Profile(f64),
    /// Cross level on tangents, reverse elevation in curves and spirals.
    CrossLevel,
    /// Difference of the cross level between two points at most so far apart (m).
    Warp(f64),
    /// The least of six successive differences of the cross level between seven low joints, 10 ft to 30 ft
    /// from one to the next.
    StaggeredJoints,
}

/// A row of the rule.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ClassLimit {
    /// The paragraph.
    pub paragraph: &'static str,
    /// The name of the quantity.
    pub name: &'static str,
    /// The quantity.
    pub quantity: ClassQuantity,
    /// The limits of classes 1 to 9, m; none where the paragraph has none.
    pub limits: [Option<f64>; CLASSES],
    /// Where they are from.
    pub mark: Mark,
}

/// The largest speeds of freight trains in classes 1 to 9, mph: 213.9 (read), 213.307 (remembered).
pub const SPEEDS: [f64; CLASSES] = [10.0, 25.0, 40.0, 60.0, 80.0, 110.0, 125.0, 160.0, 220.0];

const fn low(inches: [f64; 5]) -> [Option<f64>; CLASSES] {
    let mut limits = [None; CLASSES];
    let mut class = 0;
    while class < 5 {
        // Paragraphs write no limit for some classes, here as zero.
        if inches[class] > 0.0 {
            limits[class] = Some(inches[class] * INCH);
        }
        class += 1;
    }
    limits
}

const fn high(inches: [f64; 4]) -> [Option<f64>; CLASSES] {
    let mut limits = [None; CLASSES];
    let mut class = 0;
    while class < 4 {
        limits[class + 5] = Some(inches[class] * INCH);
        class += 1;
    }
    limits
}

const C31: f64 = 31.0 * FOOT;
const C62: f64 = 62.0 * FOOT;
const C124: f64 = 124.0 * FOOT;

const fn row(
    paragraph: &'static str,
    name: &'static str,
    quantity: ClassQuantity,
    limits: [Option<f64>; CLASSES],
    mark: Mark,
) -> ClassLimit {
    ClassLimit {
        paragraph,
        name,
        quantity,
        limits,
        mark,
    }
}

/// The rows.
pub const CLASS_LIMITS: [ClassLimit; 12] = {
    use ClassQuantity::{
        Alinement, CrossLevel, CurveAlinement, NarrowestGauge, Profile, StaggeredJoints, TangentAlinement,
        Warp, WidestGauge,
    };
    use Mark::{Read, Remembered};
    [
        row(
            "213.53",
            "gauge, widest",
            WidestGauge,
            low([58.0, 57.75, 57.75, 57.5, 57.5]),
            Read,
        ),
        row(
            "213.53",
            "gauge, narrowest",
            NarrowestGauge,
            low([56.0; 5]),
            Remembered,
        ),
        row(
            "213.55",
            "alinement 62 ft, tangent",
            TangentAlinement(C62),
            low([5.0, 3.0, 1.75, 1.5, 0.75]),
            Read,
        ),
        row(
            "213.55",
            "alinement 62 ft, curve",
            CurveAlinement(C62),
            low([5.0, 3.0, 1.75, 1.5, 0.625]),
            Remembered,
        ),
        row(
            "213.55",
            "alinement 31 ft, curve",
            CurveAlinement(C31),
            low([0.0, 0.0, 1.25, 1.0, 0.5]),
            Remembered,
        ),
        row(
            "213.63",
            "profile 62 ft",
            Profile(C62),
            low([3.0, 2.75, 2.25, 2.0, 1.25]),
            Read,
        ),
        row(
            "213.63",
            "cross level",
            CrossLevel,
            low([3.0, 2.0, 1.75, 1.25, 1.0]),
            Read,
        ),
        row(
            "213.63",
            "warp in 62 ft",
            Warp(C62),
            low([3.0, 2.25, 2.0, 1.75, 1.5]),
            Read,
        ),
        // Classes 2 to 5; remembered that class 1 has none.
        row(
            "213.63",
            "seven staggered joints",
            StaggeredJoints,
            low([0.0, 1.25, 1.25, 1.25, 1.25]),
            Read,
        ),
        // Of these three the first value was read.
        row(
            "213.327",
            "alinement 31 ft",
            Alinement(C31),
            high([0.5; 4]),
            Remembered,
        ),
        row(
            "213.327",
            "alinement 62 ft",
            Alinement(C62),
            high([0.75, 0.75, 0.75, 0.5]),
            Remembered,
        ),
        row(
            "213.327",
            "alinement 124 ft",
            Alinement(C124),
            high([1.5, 1.25, 1.0, 0.75]),
            Remembered,
        ),
    ]
};
