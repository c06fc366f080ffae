//! Horizontal alignment and cant of LandXML 1.x: lines, curves, spirals, and the cant at stations.
//!
//! ```xml
//! <LandXML><Units><Metric linearUnit="meter"/></Units><Alignments><Alignment name="Main" staStart="0">
//!   <CoordGeom>
//!     <Line length="50"/>
//!     <Spiral length="60" radiusStart="INF" radiusEnd="400" rot="ccw" spiType="clothoid"/>
//!     <Curve radius="400" length="120" rot="ccw"/>
//!   </CoordGeom>
//!   <Cant><CantStation station="50" appliedCant="0"/><CantStation station="110" appliedCant="80"/></Cant>
//! </Alignment></Alignments></LandXML>
//! ```
//!
//! Lengths are those of the attributes; a line without one is as long as its ends are apart. The distance
//! from the first to the last point, where they are given, is compared with that of the track. Cant is
//! linear between its stations. It has to be level on lines, constant in curves; in spirals it follows the
//! spiral's law here. Its unit is the user's to say: programs write millimeters or meters. Rotation `ccw`
//! is a curve to the left.
//!
//! Types of spirals are those of the format's list; `cosine` and `sineHalfWave` (an approximation of the
//! same) are cosines, `sinusoid` is Klein's, `biquadratic` and `biquadraticParabola` are Helmert's, `cubic`
//! and `cubicParabola` are this program's cubic parabola (remembered, but for the half wave and the
//! biquadratic parabola, which a published converter to IFC 4.3 maps so, November 2026).
//!
//! Not read: profiles (the track is level), station equations (refused beside cant), chains and irregular
//! lines (refused).

use input::{limits, shortened};
use quantity::SixDigits;
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use wheelrail::track::{CenterLine, CurveElements, Segment, SpiralForm};

use super::LONGEST;

/// Most elements of an alignment, and most stations of cant.
const MOST: usize = limits::TABLE_ROWS;
/// Cant that counts as none, and as the same, m.
const SAME_CANT: f64 = 1e-3;
/// Relative tolerance of radii that meet.
const SAME_RADIUS: f64 = 1e-3;
/// Distance by which the track's end may miss the alignment's, m, and the part of its length.
const CLOSES: [f64; 2] = [0.1, 1e-4];

/// A mistake in an alignment.
#[derive(Debug)]
pub(super) struct LandXmlError {
    /// The line, from 1; zero if it is about the whole.
    pub line: usize,
    /// What is found there.
    pub found: String,
    /// What to do.
    pub remedy: &'static str,
}

/// An element of the horizontal alignment.
#[derive(Clone, Copy, Debug)]
enum Shape {
    Line,
    Curve,
    Spiral(SpiralForm),
}

/// Its data: length (m), curvatures at both ends (1/m, to the left).
#[derive(Clone, Copy, Debug)]
struct Element {
    line: usize,
    shape: Shape,
    length: Option<f64>,
    curvature: [f64; 2],
    ends: [Option<[f64; 2]>; 2],
}

/// An alignment as it is written.
#[derive(Debug, Default)]
struct Alignment {
    name: String,
    start: f64,
    elements: Vec<Element>,
    /// Line, station and cant in the file's units.
    cants: Vec<(usize, f64, f64)>,
    has_equations: bool,
    has_profile: bool,
}

/// A center line with the warnings of reading.
#[derive(Debug)]
pub(super) struct Read {
    pub line: CenterLine,
    pub doubts: Vec<String>,
}

const WHOLE: &str = "export the alignment again as LandXML 1.2, with lengths, radii and types of spirals";

fn wrong(line: usize, found: impl Into<String>, remedy: &'static str) -> LandXmlError {
    LandXmlError {
        line,
        found: found.into(),
        remedy,
    }
}

/// Returns the center line of an alignment: of the one with a name, or of the only one. `cant_unit` is the
/// unit of its cant (m).
pub(super) fn center_line(
    text: &str,
    name: Option<&str>,
    cant_unit: Option<f64>,
    rail_distance: f64,
) -> Result<Read, LandXmlError> {
    let alignments = parse(text)?;
    let names = || {
        let all: Vec<&str> = alignments.iter().map(|own| own.name.as_str()).collect();
        shortened(&all.join(", "))
    };
    let own = match (name, alignments.as_slice()) {
        (_, []) => return Err(wrong(0, "there is no alignment with geometry", WHOLE)),
        (None, [own]) => own,
        (None, _) => {
            let found = format!("there are {} alignments: {}", alignments.len(), names());
            return Err(wrong(0, found, "write alignment = \"...\", one of these names"));
        }
        (Some(name), all) => all.iter().find(|own| own.name == name).ok_or_else(|| {
            let found = format!("there is no alignment {}; there are {}", shortened(name), names());
            wrong(0, found, "write alignment = \"...\", one of these names")
        })?,
    };
    own.center_line(cant_unit, rail_distance)
}

impl Alignment {
    fn center_line(&self, cant_unit: Option<f64>, rail_distance: f64) -> Result<Read, LandXmlError> {
        let level = self.cants.iter().all(|(.., cant)| *cant == 0.0);
        if let (false, true, Some((line, ..))) = (level, self.has_equations, self.cants.first()) {
            let found = "cant at stations of an alignment with station equations";
            return Err(wrong(
                *line,
                found,
                "export the cant at internal stations, without equations",
            ));
        }
        let unit = match (cant_unit, level, self.cants.first()) {
            (None, false, Some((line, ..))) => {
                let remedy = "write cant_unit = \"mm\", \"m\" or \"in\": programs differ";
                return Err(wrong(*line, "the unit of the cant is not stated", remedy));
            }
            (unit, ..) => unit.unwrap_or(1.0),
        };
        let cant = |at: f64| self.cant(at + self.start) * unit;
        let mut segments = Vec::with_capacity(self.elements.len());
        let mut at = 0.0;
        for (index, own) in self.elements.iter().enumerate() {
            let length = own.length.or_else(|| own.apart()).ok_or_else(|| {
                wrong(
                    own.line,
                    "an element without a length",
                    "write its length, or both ends of a line",
                )
            })?;
            let end = at + length;
            if end > LONGEST {
                let found = format!("the alignment is longer than {} km", LONGEST / 1000.0);
                return Err(wrong(
                    own.line,
                    found,
                    "look at the unit of lengths, or divide the alignment",
                ));
            }
            let inside = [0.0, 0.25, 0.5, 0.75, 1.0].map(|share| cant(at + share * length));
            let changes = inside.iter().any(|one| (one - inside[2]).abs() > SAME_CANT);
            match own.shape {
                Shape::Line if inside.iter().any(|one| one.abs() > SAME_CANT) => {
                    let most = inside.iter().fold(0.0_f64, |most, one| most.max(one.abs()));
                    let found = format!("a line with a cant of {} m", SixDigits(most));
                    return Err(wrong(own.line, found, CANT));
                }
                Shape::Curve if changes => {
                    let found = format!(
                        "the cant changes within a curve, from {} m to {} m",
                        SixDigits(inside[0]),
                        SixDigits(inside[4])
                    );
                    return Err(wrong(own.line, found, CANT));
                }
                _ => {}
            }
            segments.push(match own.shape {
                Shape::Line => Segment::Tangent(length),
                Shape::Spiral(form) => {
                    self.meets_neighbors(index)?;
                    Segment::Spiral(length, form)
                }
                Shape::Curve => Segment::Curve(
                    length,
                    CurveElements {
                        curvature: own.curvature[0],
                        superelevation: own.curvature[0].signum() * inside[2],
                    },
                ),
            });
            at = end;
        }
        let line = CenterLine::new(&segments, rail_distance, &[]).map_err(|error| {
            wrong(
                0,
                format!("{error}"),
                "segments count from the first element of CoordGeom",
            )
        })?;
        let mut doubts = Vec::new();
        doubts.extend(self.misses(&line));
        if self.has_profile {
            doubts.push(format!(
                "{}: the profile of heights is not read; the track is level",
                self.name
            ));
        }
        Ok(Read { line, doubts })
    }

    /// Returns the cant at a station, in the file's unit: linear between stations, held before and after.
    fn cant(&self, station: f64) -> f64 {
        let after = self.cants.partition_point(|(_, own, _)| *own <= station);
        let before = after.checked_sub(1).and_then(|index| self.cants.get(index));
        match (before, self.cants.get(after)) {
            (Some((_, from, one)), Some((_, to, other))) => {
                one + (other - one) * (station - from) / (to - from)
            }
            (Some((.., own)), None) | (None, Some((.., own))) => *own,
            (None, None) => 0.0,
        }
    }

    /// Checks that a spiral has the radii of the elements beside it.
    fn meets_neighbors(&self, index: usize) -> Result<(), LandXmlError> {
        let own = &self.elements[index];
        let before = index
            .checked_sub(1)
            .map(|index| self.elements[index].curvature[1]);
        let after = self.elements.get(index + 1).map(|next| next.curvature[0]);
        for (own_end, neighbor, end) in [
            (own.curvature[0], before, "start"),
            (own.curvature[1], after, "end"),
        ] {
            let Some(neighbor) = neighbor else { continue };
            let size = own_end.abs().max(neighbor.abs());
            if (own_end - neighbor).abs() > SAME_RADIUS * size {
                let radius = |curvature: f64| match curvature {
                    0.0 => "a tangent".to_owned(),
                    own if own > 0.0 => format!("{} m to the left", SixDigits(1.0 / own)),
                    own => format!("{} m to the right", SixDigits(-1.0 / own)),
                };
                let found = format!(
                    "a spiral whose radius at its {end} is {}, beside {}",
                    radius(own_end),
                    radius(neighbor)
                );
                return Err(wrong(
                    own.line,
                    found,
                    "curvature must not jump: look at radii and rot",
                ));
            }
        }
        Ok(())
    }

    /// Returns how far the track's end misses the alignment's, if it does.
    fn misses(&self, line: &CenterLine) -> Option<String> {
        let [begin, end] = [self.elements.first()?.ends[0]?, self.elements.last()?.ends[1]?];
        let written = libm::hypot(end[0] - begin[0], end[1] - begin[1]);
        let [x, y, _] = line.at(line.length()).position;
        let found = libm::hypot(x, y);
        let [absolute, relative] = CLOSES;
        ((found - written).abs() > absolute + relative * line.length()).then(|| {
            format!(
                "{}: from the first to the last point the track is {} m long, by coordinates {} m: look at \
                 lengths, radii, rot and types of spirals",
                self.name,
                SixDigits(found),
                SixDigits(written)
            )
        })
    }
}

const CANT: &str = "cant is constant in curves, zero on lines, and changes in spirals; correct the \
                    stations of the cant, or write the center line as segments";

impl Element {
    /// Returns the distance of both ends of a line, m.
    fn apart(&self) -> Option<f64> {
        match (self.shape, self.ends) {
            (Shape::Line, [Some(a), Some(b)]) => Some(libm::hypot(b[0] - a[0], b[1] - a[1])),
            _ => None,
        }
    }
}

/// Reads all alignments that have geometry.
fn parse(text: &str) -> Result<Vec<Alignment>, LandXmlError> {
    let mut reader = Reader::from_str(text);
    let mut found: Vec<Alignment> = Vec::new();
    let mut path: Vec<String> = Vec::new();
    let mut unit = None;
    let mut points = String::new();
    let lines = Lines::of(text);
    loop {
        let line = lines.at(reader.buffer_position() as usize);
        let event = reader.read_event();
        let event = event.map_err(|error| wrong(line, format!("no XML: {error}"), WHOLE))?;
        let (start, empty) = match &event {
            Event::Eof => break,
            Event::Start(start) => (start, false),
            Event::Empty(start) => (start, true),
            Event::Text(own) => {
                points.push_str(own);
                continue;
            }
            Event::End(_) => {
                let name = path.pop().unwrap_or_default();
                if let ("Start" | "End", Some(alignment)) = (name.as_str(), found.last_mut())
                    && path.iter().any(|own| own == "CoordGeom")
                    && let Some(element) = alignment.elements.last_mut()
                {
                    let numbers: Vec<f64> = points.split_whitespace().flat_map(str::parse).collect();
                    if let [a, b, ..] = numbers[..] {
                        let scale = unit.unwrap_or(1.0);
                        element.ends[usize::from(name == "End")] = Some([a * scale, b * scale]);
                    }
                }
                continue;
            }
            _ => continue,
        };
        points.clear();
        let name = start.local_name().as_ref().to_owned();
        let tag = Tag {
            start,
            line,
            name: &name,
        };
        match name.as_str() {
            "Metric" | "Imperial" => unit = Some(tag.linear_unit()?),
            "Alignment" => {
                let unit = unit.ok_or_else(|| wrong(line, "no Units before the alignment", WHOLE))?;
                found.push(Alignment {
                    name: tag.text("name")?.unwrap_or_default(),
                    start: tag.number("staStart")?.unwrap_or(0.0) * unit,
                    ..Alignment::default()
                });
            }
            _ => {
                if let (Some(own), Some(unit)) = (found.last_mut(), unit) {
                    let inside = path.last().map(String::as_str);
                    own.take(&tag, inside, unit)?;
                }
            }
        }
        if !empty {
            path.push(name);
            if path.len() > limits::NESTING {
                return Err(wrong(line, "elements lie too deep in each other", WHOLE));
            }
        }
    }
    found.retain(|own| !own.elements.is_empty());
    Ok(found)
}

impl Alignment {
    /// Takes an element of the file inside another one.
    fn take(&mut self, tag: &Tag<'_>, inside: Option<&str>, unit: f64) -> Result<(), LandXmlError> {
        let full = self.elements.len() >= MOST || self.cants.len() >= MOST;
        if full {
            return Err(wrong(
                tag.line,
                format!("more than {MOST} elements"),
                "divide the alignment",
            ));
        }
        match (inside, tag.name) {
            (Some("CoordGeom"), kind) => {
                let element = tag.element(kind, unit)?;
                self.elements.push(element);
            }
            (Some("Cant"), "CantStation") => {
                let station = tag.needed("station")? * unit;
                if self.cants.last().is_some_and(|(_, before, _)| *before >= station) {
                    return Err(wrong(
                        tag.line,
                        "a station of cant that does not follow the one before it",
                        CANT,
                    ));
                }
                let sign = match tag.text("adverse")?.as_deref() {
                    Some("true") => -1.0,
                    _ => 1.0,
                };
                self.cants
                    .push((tag.line, station, sign * tag.needed("appliedCant")?.abs()));
            }
            (_, "StaEquation") => self.has_equations = true,
            (_, "ProfAlign") => self.has_profile = true,
            _ => {}
        }
        Ok(())
    }
}

/// The begin of an element, with its line.
struct Tag<'t> {
    start: &'t BytesStart<'t>,
    line: usize,
    name: &'t str,
}

impl Tag<'_> {
    fn text(&self, name: &str) -> Result<Option<String>, LandXmlError> {
        let broken = |error: String| wrong(self.line, format!("no XML: {error}"), WHOLE);
        let found = self
            .start
            .try_get_attribute(name)
            .map_err(|error| broken(error.to_string()))?;
        Ok(found.map(|own| own.value.trim().to_owned()))
    }

    fn number(&self, name: &str) -> Result<Option<f64>, LandXmlError> {
        let Some(text) = self.text(name)? else {
            return Ok(None);
        };
        let number = text
            .parse::<f64>()
            .ok()
            .filter(|own| own.is_finite() && own.abs() < 1e9);
        number.map(Some).ok_or_else(|| {
            let found = format!("{name} of {} is {}", self.name, shortened(&text));
            wrong(self.line, found, "a number is expected")
        })
    }

    fn needed(&self, name: &str) -> Result<f64, LandXmlError> {
        self.number(name)?
            .ok_or_else(|| wrong(self.line, format!("{} has no {name}", self.name), WHOLE))
    }

    /// Returns the unit of lengths, m.
    fn linear_unit(&self) -> Result<f64, LandXmlError> {
        let name = self.text("linearUnit")?.unwrap_or_default();
        match name.as_str() {
            "meter" => Ok(1.0),
            "millimeter" => Ok(1e-3),
            "centimeter" => Ok(1e-2),
            "kilometer" => Ok(1e3),
            "foot" => Ok(0.3048),
            "USSurveyFoot" => Ok(1200.0 / 3937.0),
            "inch" => Ok(0.0254),
            "mile" => Ok(1609.344),
            _ => {
                let found = format!("the unit of lengths is {}", shortened(&name));
                Err(wrong(
                    self.line,
                    found,
                    "meter, millimeter, foot, USSurveyFoot are known",
                ))
            }
        }
    }

    /// Returns 1 to the left, -1 to the right.
    fn turn(&self) -> Result<f64, LandXmlError> {
        match self.text("rot")?.as_deref() {
            Some("ccw") => Ok(1.0),
            Some("cw") => Ok(-1.0),
            _ => Err(wrong(
                self.line,
                format!("rot of {} is neither cw nor ccw", self.name),
                WHOLE,
            )),
        }
    }

    /// Returns the curvature of a radius, 1/m.
    fn curvature(&self, name: &str, unit: f64) -> Result<f64, LandXmlError> {
        match self.text(name)? {
            Some(text) if text.eq_ignore_ascii_case("inf") => Ok(0.0),
            _ => match self.needed(name)? * unit {
                radius if radius > 1.0 => Ok(1.0 / radius),
                radius => {
                    let found = format!("{name} of {} is {} m", self.name, SixDigits(radius));
                    Err(wrong(
                        self.line,
                        found,
                        "a radius of more than 1 m, or INF, is expected",
                    ))
                }
            },
        }
    }

    fn element(&self, kind: &str, unit: f64) -> Result<Element, LandXmlError> {
        let length = self.number("length")?.map(|own| own * unit);
        let (shape, curvature) = match kind {
            "Line" => (Shape::Line, [0.0; 2]),
            "Curve" => {
                let curvature = self.turn()? * self.curvature("radius", unit)?;
                (Shape::Curve, [curvature; 2])
            }
            "Spiral" => {
                let turn = self.turn()?;
                let ends = ["radiusStart", "radiusEnd"].map(|name| self.curvature(name, unit));
                let [start, end] = ends;
                (Shape::Spiral(self.form()?), [turn * start?, turn * end?])
            }
            _ => {
                let found = format!("{} is no line, curve or spiral", shortened(kind));
                return Err(wrong(
                    self.line,
                    found,
                    "other elements of CoordGeom are not read: replace it",
                ));
            }
        };
        Ok(Element {
            line: self.line,
            shape,
            length,
            curvature,
            ends: [None; 2],
        })
    }

    fn form(&self) -> Result<SpiralForm, LandXmlError> {
        let name = self.text("spiType")?.unwrap_or_default();
        Ok(match name.as_str() {
            "clothoid" => SpiralForm::Clothoid,
            "bloss" => SpiralForm::Bloss,
            "cosine" | "sineHalfWave" => SpiralForm::Cosine,
            "sinusoid" => SpiralForm::Sine,
            "biquadratic" | "biquadraticParabola" => SpiralForm::Helmert,
            "cubic" | "cubicParabola" => SpiralForm::CubicParabola,
            _ => {
                let found = format!("a spiral of the type {}", shortened(&name));
                let remedy = "clothoid, bloss, cosine, sineHalfWave, sinusoid, biquadratic and cubicParabola \
                              are read";
                return Err(wrong(self.line, found, remedy));
            }
        })
    }
}

/// The ends of the lines of a text.
struct Lines(Vec<usize>);

impl Lines {
    fn of(text: &str) -> Self {
        Self(text.match_indices('\n').map(|(at, _)| at).collect())
    }

    /// Returns the line (from 1) of the element that begins at or after a byte.
    fn at(&self, byte: usize) -> usize {
        self.0.partition_point(|end| *end < byte) + 1
    }
}
