//! A rigid wheelset on rigid rails: heights, roll, rolling radii and contact angles over the lateral shift.
//!
//! At each shift the wheelset is lowered and rolled until both wheels touch. The results are diagnostics
//! (rolling radius difference, contact angles, equivalent conicity) and the source of linear geometry;
//! simulations use [`contact`](crate::contact), where bodies are elastic.
//!
//! Axes: y to the left, z up, the origin midway between the rails at the height of their tops. Shifts are
//! positive to the left and are measured at that height, where flanges meet rails; the roll is positive with
//! the right side down.

use std::sync::Arc;

use crate::contact::{ContactPair, PatchForm, RigidTouch, Side, VaryingRail, WheelPose};
use crate::hertz::Material;
use crate::loaded::Seat;
use crate::profile::{Profile, ProfileError, SlicedProfile, check_gauge};

/// Largest roll that is looked for, rad.
const LARGEST_ROLL: f64 = 0.3;

/// Step of the search for the gauge at which wheels reach their rails, m.
const REACH_STEP: f64 = 2e-3;

/// Distances of a wheelset and a track, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Distance of the tape circles.
    pub tape_distance: f64,
    /// Gauge.
    pub gauge: f64,
    /// Depth below the datum of the rails' profiles, z = 0 of their files, at which gauge is measured.
    pub gauge_depth: f64,
}

/// Two wheels and two rails.
#[derive(Clone, Debug)]
pub struct RigidWheelset {
    pairs: [ContactPair; 2],
    layout: Layout,
    /// Distances of the origins of the rails' profiles from the middle of the track, m.
    origins: [f64; 2],
    /// Heights of the rails' tops above the origins of their profiles, m.
    tops: [f64; 2],
}

/// A position in which both wheels touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RigidPosition {
    /// Lateral shift at the height of the rails' tops, m.
    pub shift: f64,
    /// Height of the wheelset's center, m.
    pub height: f64,
    /// Lateral place of the wheelset's center, m.
    pub center: f64,
    /// Roll, rad.
    pub roll: f64,
    /// Touching at the left and the right wheel, in the axes of their contacts.
    pub touches: [RigidTouch; 2],
}

impl RigidPosition {
    /// Returns the rolling radius of the left wheel less that of the right wheel, m.
    #[must_use]
    pub fn rolling_radius_difference(&self) -> f64 {
        self.touches[0].radius - self.touches[1].radius
    }

    /// Returns the contact angles left and right, rad: positive where the plane of contact rises to the field
    /// side.
    #[must_use]
    pub fn contact_angles(&self) -> [f64; 2] {
        self.touches.map(|touch| libm::atan(touch.slope))
    }
}

impl RigidWheelset {
    /// Returns wheels (left, right) of nominal radii (m) on rails, which are placed by gauge and highest
    /// point.
    ///
    /// # Errors
    /// A profile is of the wrong kind, a number is not admissible, the datum of a rail is not its top, or the
    /// wheelset does not fit between the rails.
    pub fn new(
        wheels: [&Profile; 2],
        radii: [f64; 2],
        rails: [&Profile; 2],
        layout: Layout,
        material: Material,
    ) -> Result<Self, ProfileError> {
        let Layout {
            tape_distance,
            gauge,
            gauge_depth,
        } = layout;
        for (what, value) in [("distance of the tape circles", tape_distance), ("gauge", gauge)] {
            let range = [0.1, 10.0];
            if !(value > range[0] && value < range[1]) {
                return Err(ProfileError::Length { what, value, range });
            }
        }
        check_gauge(wheels, rails, tape_distance, gauge, gauge_depth)?;
        let tops = rails.map(|rail| rail.top()[1]);
        let side = |i: usize| -> Result<(ContactPair, f64), ProfileError> {
            let rail = rails[i].moved([0.0, -tops[i]]);
            let origin = 0.5 * gauge - rail.gauge_point(gauge_depth);
            Ok((ContactPair::new(wheels[i], radii[i], &rail, material)?, origin))
        };
        let [(left, left_origin), (right, right_origin)] = [side(0)?, side(1)?];
        Ok(Self {
            pairs: [left, right],
            layout,
            origins: [left_origin, right_origin],
            tops,
        })
    }

    /// Returns rails that change along the track, prepared for the search; their sections have the origins of
    /// the rails of [`RigidWheelset::new`].
    ///
    /// # Errors
    /// A section is no rail with its datum.
    pub fn rails_over(
        &self,
        rails: [Option<&SlicedProfile>; 2],
    ) -> Result<[Option<Arc<VaryingRail>>; 2], ProfileError> {
        let over = |i: usize| -> Result<Option<Arc<VaryingRail>>, ProfileError> {
            let placed = rails[i].map(|rail| rail.moved([0.0, -self.tops[i]]));
            placed
                .map(|rail| VaryingRail::new(&rail).map(Arc::new))
                .transpose()
        };
        Ok([over(0)?, over(1)?])
    }

    /// Returns the same wheelset with patches of a form.
    #[must_use]
    pub fn with_patches(mut self, patch: PatchForm) -> Self {
        self.pairs = self.pairs.map(|pair| pair.with_patches(patch));
        self
    }

    /// Returns the pairs of wheel and rail, left and right.
    #[must_use]
    pub fn pairs(&self) -> &[ContactPair; 2] {
        &self.pairs
    }

    /// Returns the distances (m) of the origins of the rails' profiles from the middle of the track, left and
    /// right.
    #[must_use]
    pub fn rail_origins(&self) -> [f64; 2] {
        self.origins
    }

    /// Returns where both wheels stand in a position: on their treads, flanges or rims.
    #[must_use]
    pub fn seats(&self, position: &RigidPosition) -> [Seat; 2] {
        [0, 1].map(|side| Seat::of(&self.pairs[side], position.touches[side].profile))
    }

    /// Returns the mean of the nominal radii, m.
    #[must_use]
    pub fn nominal_radius(&self) -> f64 {
        0.5 * (self.pairs[0].nominal_radius() + self.pairs[1].nominal_radius())
    }

    /// Checks that the wheelset in the middle of the track stands on the treads of both wheels: not on the
    /// outer edges of its rims, nor between or beside the rails.
    ///
    /// # Errors
    /// [`ProfileError::ShortOfRails`].
    pub fn check_reach(&self) -> Result<(), ProfileError> {
        if self.reaches(0.0) {
            return Ok(());
        }
        // How far rails must come inwards, by bisection, and with it the largest gauge.
        let (mut short, mut reached) = (0.0, 0.0);
        let mut inwards = REACH_STEP;
        while inwards < 0.5 * self.layout.gauge {
            if self.reaches(inwards) {
                reached = inwards;
                break;
            }
            short = inwards;
            inwards += REACH_STEP;
        }
        for _ in 0..40 {
            let middle = 0.5 * (short + reached);
            *(if self.reaches(middle) {
                &mut reached
            } else {
                &mut short
            }) = middle;
        }
        let rims = self.pairs.iter().map(|pair| pair.wheel_range()[1]).sum::<f64>();
        Err(ProfileError::ShortOfRails {
            gauge: self.layout.gauge,
            span: self.layout.tape_distance + rims,
            largest: (reached > 0.0).then_some(self.layout.gauge - 2.0 * reached),
        })
    }

    /// Returns whether both wheels stand on their treads in the middle of the track, with rails this far (m)
    /// inwards of their places.
    fn reaches(&self, inwards: f64) -> bool {
        [Side::Left, Side::Right].into_iter().all(|side| {
            let index = usize::from(side == Side::Right);
            let sign = if side == Side::Left { 1.0 } else { -1.0 };
            let pose = self.pose(side, [sign * inwards, self.nominal_radius()], 0.0, 0.0);
            let pair = &self.pairs[index];
            let touch = pair.touch_over_rail(&pose);
            touch.is_some_and(|touch| Seat::of(pair, touch.profile) == Seat::OnRail)
        })
    }

    /// Returns the position at a lateral shift (m) and a yaw (rad, to the left); none if a wheel is not over
    /// its rail.
    #[must_use]
    pub fn position(&self, shift: f64, yaw: f64) -> Option<RigidPosition> {
        let radius = self.nominal_radius();
        // The center is taken at a fixed height over the pivot; then both touches are found for a roll.
        let at = |roll: f64| {
            let center = shift - radius * libm::sin(roll);
            let touches = [Side::Left, Side::Right].map(|side| {
                let index = usize::from(side == Side::Right);
                let pose = self.pose(side, [center, radius], yaw, roll);
                self.pairs[index].touch(&pose)
            });
            let [Some(left), Some(right)] = touches else {
                return None;
            };
            Some((center, [left, right]))
        };
        // The left side rises with the roll: the difference of overlaps falls.
        let difference = |roll: f64| at(roll).map(|(_, [left, right])| left.overlap - right.overlap);
        let (mut low, mut high) = (0.0, 0.0);
        let begin = difference(0.0)?;
        let mut width = 1e-4;
        let mut values = [begin, begin];
        while values[0] < 0.0 || values[1] > 0.0 {
            if width > LARGEST_ROLL {
                return None;
            }
            if values[0] < 0.0 {
                low = -width;
                values[0] = difference(low)?;
            } else {
                high = width;
                values[1] = difference(high)?;
            }
            width *= 2.0;
        }
        for step in 0..80 {
            if high - low < 1e-15 {
                break;
            }
            // The false position, with bisection at every third step.
            let share = values[0] / (values[0] - values[1]);
            let middle = match step % 3 == 2 || !share.is_finite() {
                true => 0.5 * (low + high),
                false => low + (high - low) * share,
            };
            let found = difference(middle)?;
            if found == 0.0 {
                (low, high) = (middle, middle);
            } else if found > 0.0 {
                (low, values[0]) = (middle, found);
            } else {
                (high, values[1]) = (middle, found);
            }
        }
        let roll = 0.5 * (low + high);
        let (center, mut touches) = at(roll)?;
        let lift = 0.5 * (touches[0].overlap + touches[1].overlap);
        for touch in &mut touches {
            touch.overlap -= lift;
            touch.place[2] += lift;
        }
        Some(RigidPosition {
            shift,
            height: radius + lift,
            center,
            roll,
            touches,
        })
    }

    /// Returns the position at a lateral shift (m) with a level axle: each rail is lifted on its own until it
    /// touches. EN 15302 neglects the roll of the wheelset in this way.
    #[must_use]
    pub fn level_position(&self, shift: f64) -> Option<RigidPosition> {
        let radius = self.nominal_radius();
        let [Some(mut left), Some(mut right)] = [Side::Left, Side::Right].map(|side| {
            let index = usize::from(side == Side::Right);
            self.pairs[index].touch(&self.pose(side, [shift, radius], 0.0, 0.0))
        }) else {
            return None;
        };
        let lift = 0.5 * (left.overlap + right.overlap);
        for touch in [&mut left, &mut right] {
            touch.place[2] += touch.overlap;
            touch.overlap = 0.0;
        }
        Some(RigidPosition {
            shift,
            height: radius + lift,
            center: shift,
            roll: 0.0,
            touches: [left, right],
        })
    }

    /// Returns positions at `count + 1` shifts from `-largest` to `largest` (m), with a level axle or with
    /// roll; those where a wheel is not over its rail are left out.
    #[must_use]
    pub fn sweep(&self, largest: f64, count: usize, level: bool) -> Vec<RigidPosition> {
        (0..=count)
            .filter_map(|i| {
                let shift = largest * (2.0 * i as f64 / count.max(1) as f64 - 1.0);
                match level {
                    true => self.level_position(shift),
                    false => self.position(shift, 0.0),
                }
            })
            .collect()
    }

    /// Returns the pose of the wheel at a side, from the center of the wheelset (m, y to the left and z up),
    /// its yaw (to the left) and its roll (right side down), rad.
    #[must_use]
    pub fn pose(&self, side: Side, [y, z]: [f64; 2], yaw: f64, roll: f64) -> WheelPose<f64> {
        let half = 0.5 * self.layout.tape_distance;
        let ((_, cos_yaw), (sin_roll, cos_roll)) = (libm::sincos(yaw), libm::sincos(roll));
        let (sign, index) = match side {
            Side::Left => (1.0, 0),
            Side::Right => (-1.0, 1),
        };
        let center = [
            y + sign * (half * cos_yaw * cos_roll - self.origins[index]),
            z + sign * half * sin_roll,
        ];
        WheelPose::of(side, center, yaw, roll)
    }
}
