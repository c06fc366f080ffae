//! Points from Simpack's `.prr` and `.prw`; see [`points`](super).

use input::Separated;

use super::{Points, line_error, number_of};
use crate::profile::{ProfileError, ProfileKind};

impl Points {
    /// Reads Simpack's format; `name` is what messages call it.
    ///
    /// # Errors
    /// A line is wrong, or there are too many.
    pub fn from_simpack(name: &str, text: &str) -> Result<Self, ProfileError> {
        let mut read = Self::new(name, &[]);
        let mut keys = SimpackKeys::default();
        // Spaces separate, points are the decimal signs.
        let mut table = Separated::of("");
        let (mut block, mut ended, mut last) = (String::new(), false, 1);
        for (index, line) in text.lines().enumerate() {
            let number = index + 1;
            last = number;
            let line = line.split(['!', '%']).next().unwrap_or("").trim();
            if line.is_empty() {
                continue;
            }
            if let Some(opened) = line.strip_suffix(".begin") {
                block = opened.to_ascii_lowercase();
            } else if line.ends_with(".end") {
                ended |= block == "point";
                block = String::new();
            } else if block == "point" {
                let mut cells = line.split_whitespace();
                let mut point = [0.0; 2];
                for value in &mut point {
                    *value = number_of(&mut table, name, number, cells.next().unwrap_or(""))?;
                }
                read.push(point, number)?;
            } else if let Some((key, value)) = line.split_once('=') {
                keys.set(name, number, &block, key.trim(), value.trim())?;
            }
        }
        if !ended {
            return Err(line_error(
                name,
                last,
                "the block of points does not end".into(),
                "a file of Simpack has its points between point.begin and point.end",
            ));
        }
        keys.apply(&mut read);
        Ok(read)
    }
}

/// The keys that change points.
#[derive(Clone, Debug)]
struct SimpackKeys {
    kind: Option<ProfileKind>,
    shift: [f64; 2],
    rotate: f64,
    bounds: [[f64; 2]; 2],
    mirror: [bool; 2],
    /// User units in 1 m and 1 rad.
    units: [f64; 2],
}

impl Default for SimpackKeys {
    fn default() -> Self {
        Self {
            kind: None,
            shift: [0.0; 2],
            rotate: 0.0,
            bounds: [[1.0, 0.0]; 2],
            mirror: [false; 2],
            units: [1.0; 2],
        }
    }
}

impl SimpackKeys {
    fn set(
        &mut self,
        name: &str,
        line: usize,
        block: &str,
        key: &str,
        value: &str,
    ) -> Result<(), ProfileError> {
        let number = || number_of(&mut Separated::of(""), name, line, value);
        match (block, key) {
            ("header", "type") => {
                self.kind = Some(match number()? {
                    0.0 => ProfileKind::Rail,
                    1.0 => ProfileKind::Wheel,
                    other => {
                        let found = format!("the type {other} is unknown");
                        return Err(line_error(name, line, found, "0 is a rail, 1 is a wheel"));
                    }
                });
            }
            (_, "shift.y") => self.shift[0] = number()?,
            (_, "shift.z") => self.shift[1] = number()?,
            (_, "rotate") => self.rotate = number()?,
            (_, "bound.y.min") => self.bounds[0][0] = number()?,
            (_, "bound.y.max") => self.bounds[0][1] = number()?,
            (_, "bound.z.min") => self.bounds[1][0] = number()?,
            (_, "bound.z.max") => self.bounds[1][1] = number()?,
            (_, "mirror.y") => self.mirror[0] = number()? != 0.0,
            (_, "mirror.z") => self.mirror[1] = number()? != 0.0,
            (_, "units.len.f") => self.units[0] = positive(name, line, number()?)?,
            (_, "units.ang.f") => self.units[1] = positive(name, line, number()?)?,
            _ => {}
        }
        Ok(())
    }

    fn apply(&self, read: &mut Points) {
        read.kind = self.kind;
        let (sine, cosine) = libm::sincos(self.rotate / self.units[1]);
        let (points, lines) = (std::mem::take(&mut read.points), std::mem::take(&mut read.lines));
        for ([y, z], line) in points.into_iter().zip(lines) {
            let (y, z) = (y + self.shift[0], z + self.shift[1]);
            let (y, z) = (y * cosine - z * sine, y * sine + z * cosine);
            let inside = |value: f64, [low, high]: [f64; 2]| low > high || (low..=high).contains(&value);
            if !(inside(y, self.bounds[0]) && inside(z, self.bounds[1])) {
                continue;
            }
            let sign = self.mirror.map(|mirrored| if mirrored { -1.0 } else { 1.0 });
            // Simpack's z points down.
            read.points
                .push([sign[0] * y / self.units[0], -sign[1] * z / self.units[0]]);
            read.lines.push(line);
        }
    }
}

fn positive(name: &str, line: usize, number: f64) -> Result<f64, ProfileError> {
    match number > 0.0 {
        true => Ok(number),
        false => Err(line_error(
            name,
            line,
            format!("the unit factor {number} is not positive"),
            "1000 stands for mm, 1 for m",
        )),
    }
}
