//! The sections of the wedge's faces, `[column_face]` and `[slope_face]`, the same in cases of a wedge and of
//! a truck: read over values that hold where a key is left out, written line by line.

use super::face_values::{self as values, PadSection, Surface};
use super::field::{Reach, Written};
use super::friction::COEFFICIENT;
use super::page::FRICTION;
use super::problem::Problems;
use super::section::{self, CaseSection, Range};
use super::table::{self, QuantityTable, TableForm};
use super::tables::Tables;
use crate::reader::schema::Form;
use quantity::{Kind, Quantity};
use wedge::face::{DepthMap, FaceProperties, FrictionMap, Grid, STRIBECK_SPEED};

/// The names of the sections, in the order of [`wedge::outputs::FACES`].
pub(crate) const SECTIONS: [&str; 2] = ["column_face", "slope_face"];
/// The subjects of the sections.
pub(crate) const ABOUT: [&str; 2] = [
    "The wedge's vertical face at the column. A surface is \"flat\", or one of\n\
     # { shape = \"crown\", radius = \"60 in\", direction = \"up\" }       direction \"up\" the face \
     or \"across\" it; or shape \"hollow\"\n\
     #   and worn_flat = \"0.02 in\" for a wedge's crown worn flat from its crest by this depth; the depth \
     itself lifts the\n\
     #                                                wedge as wear or rise of [wedge]\n\
     # { shape = \"table\", direction = \"up\", points = [[place, depth], ...] }   from edge to edge, \
     places from the middle, up or to\n\
     #                                                the left; or file = \"profile.csv\"",
    "The wedge's slope face at the slope of the bolster's pocket.",
];

/// `[column_face]` or `[slope_face]`
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FaceSection {
    /// Points up the face and across it.
    pub grid: Grid,
    /// The wedge's surface.
    pub wedge_surface: Surface,
    /// A map of its wear.
    pub wedge_wear: Option<QuantityTable<3>>,
    /// The surface that it touches.
    pub counterface: Surface,
    /// A map of its wear.
    pub counterface_wear: Option<QuantityTable<3>>,
    /// Coefficient of sliding; left out, that of rest.
    pub sliding_friction: Option<f64>,
    /// Slip speed of half of the way from rest to sliding.
    pub stribeck_speed: Option<Quantity>,
    /// Load of the face at which its coefficients are half of those without load.
    pub friction_half_load: Option<Quantity>,
    /// Factors of the coefficients over the face.
    pub friction_map: FrictionMap,
    /// A resilient pad.
    pub pad: Option<PadSection>,
}

/// A line of a section.
pub(crate) struct FaceLine {
    pub key: &'static str,
    /// The value there; nothing if the key is left out.
    pub value: Option<Written>,
    /// The admissible values.
    pub example: &'static str,
    pub comment: &'static str,
}

impl FaceSection {
    /// The keys of the section, in the order of its lines.
    pub(crate) const KEYS: &[&str] = &[
        "grid",
        "wedge_surface",
        "wedge_wear",
        "counterface",
        "counterface_wear",
        "sliding_friction",
        "stribeck_speed",
        "friction_half_load",
        "friction_map",
        "pad",
    ];

    /// Returns what may stand at these keys.
    pub(crate) fn forms() -> [Form; 10] {
        [
            Form::Counts,
            Form::Described,
            Form::Rows,
            Form::Described,
            Form::Rows,
            Form::number(COEFFICIENT),
            Form::Quantity(Kind::Speed),
            Form::Quantity(Kind::Force),
            Form::Grid,
            Form::Table,
        ]
    }

    /// Reads what a section says over these values.
    pub(crate) fn read_over(
        &self,
        s: &CaseSection<'_>,
        tables: Tables<'_>,
        problems: &mut Problems,
    ) -> Option<Self> {
        let node = |key: &str| s.table.get(key).map(|node| (node, s.path_of(key)));
        let grid = match node("grid") {
            Some((node, path)) => values::grid(node, &path, problems),
            None => Some(self.grid),
        };
        let mut surface = |key: &str, own: &Surface| match node(key) {
            Some((node, path)) => Surface::read(node, &path, tables, problems),
            None => Some(own.clone()),
        };
        let wedge_surface = surface("wedge_surface", &self.wedge_surface);
        let counterface = surface("counterface", &self.counterface);
        let mut worn = |key: &str, own: &Option<QuantityTable<3>>| match node(key) {
            Some((node, path)) => table::read(node, &path, &TableForm::map(), tables, problems).map(Some),
            None => Some(own.clone()),
        };
        let wedge_wear = worn("wedge_wear", &self.wedge_wear);
        let counterface_wear = worn("counterface_wear", &self.counterface_wear);
        let sliding_friction = match node("sliding_friction") {
            Some(_) => s
                .number("sliding_friction", COEFFICIENT, "0.3", problems)
                .map(Some),
            None => Some(self.sliding_friction),
        };
        let mut optional = |key: &str, kind: Kind, own: &Option<Quantity>| match node(key) {
            Some((node, path)) => section::quantity(node, &path, kind, Range::Positive, problems).map(Some),
            None => Some(own.clone()),
        };
        let stribeck_speed = optional("stribeck_speed", Kind::Speed, &self.stribeck_speed);
        let friction_half_load = optional("friction_half_load", Kind::Force, &self.friction_half_load);
        let friction_map = match node("friction_map") {
            Some((node, path)) => values::map(node, &path, problems),
            None => Some(self.friction_map.clone()),
        };
        let pad = match node("pad") {
            Some((node, path)) => PadSection::read(node, &path, problems).map(Some),
            None => Some(self.pad.clone()),
        };
        Some(Self {
            grid: grid?,
            wedge_surface: wedge_surface?,
            wedge_wear: wedge_wear?,
            counterface: counterface?,
            counterface_wear: counterface_wear?,
            sliding_friction: sliding_friction?,
            stribeck_speed: stribeck_speed?,
            friction_half_load: friction_half_load?,
            friction_map: friction_map?,
            pad: pad?,
        })
    }

    /// Returns its lines, in the order of [`FaceSection::KEYS`].
    pub(crate) fn lines(&self) -> Vec<FaceLine> {
        let quantity = |value: &Option<Quantity>, kind: Kind| {
            let value = value.as_ref();
            value.map(|value| Written::quantity(value, kind, Reach::Wide))
        };
        let values = [
            (
                Some(Written::toml(format!("[{}, {}]", self.grid.up, self.grid.across))),
                "",
            ),
            (Some(self.wedge_surface.written()), ""),
            (
                self.wedge_wear.as_ref().map(values::depths_written),
                "\"column_wear.csv\"",
            ),
            (Some(self.counterface.written()), ""),
            (
                self.counterface_wear.as_ref().map(values::depths_written),
                "\"column_wear.csv\"",
            ),
            (
                self.sliding_friction
                    .map(|value| Written::number(value, FRICTION)),
                "0.3",
            ),
            (quantity(&self.stribeck_speed, Kind::Speed), "\"0.1 in/s\""),
            (quantity(&self.friction_half_load, Kind::Force), "\"20000 lbf\""),
            (
                values::map_written(&self.friction_map),
                "[[1.0, 1.0], [0.5, 0.5]]",
            ),
            (self.pad.as_ref().map(PadSection::written), PadSection::EXAMPLE),
        ];
        const COMMENTS: [&str; 10] = [
            "points up the face and across it, edges included; [2, 2]: the corners. More points spread the \
             pressure",
            "the wedge's surface: \"flat\", or { shape = \"crown\", radius = \"60 in\", direction = \"up\" \
             }, ...",
            "wear of the wedge's surface beyond that: a CSV file of up [in], across [in], depth [in], places \
             from the middle; or the same as a list of points; left out, none",
            "the surface that it touches, in the same words",
            "wear of that surface, as wedge_wear; at least four places up and four across; left out, none",
            "coefficient of sliding; left out, that of rest, which is friction.column or friction.slope",
            "slip speed at which half of the way from rest to sliding is gone; left out, 0.1 in/s",
            "load of the face at which its coefficients are half of those without load; left out, no \
             dependence",
            "factors of the coefficients, rows from the lower edge, each from the right to the left edge; \
             left out, 1",
            "a resilient pad in place of contact.stiffness and .damping, with friction of its own; left \
             out, steel on steel",
        ];
        let lines = Self::KEYS.iter().zip(values).zip(COMMENTS);
        lines
            .map(|((key, (value, example)), comment)| FaceLine {
                key,
                value,
                example,
                comment,
            })
            .collect()
    }

    /// Returns the face, SI, or the key and the reason why there is none.
    pub(crate) fn resolve(&self) -> Result<FaceProperties, (&'static str, String)> {
        let si = |quantity: &Option<Quantity>| quantity.as_ref().map(Quantity::to_si);
        Ok(FaceProperties {
            grid: self.grid,
            wedge_surface: self
                .wedge_surface
                .resolve()
                .map_err(|error| ("wedge_surface", error.to_string()))?,
            wedge_wear: depths(&self.wedge_wear).map_err(|error| ("wedge_wear", error))?,
            counterface_wear: depths(&self.counterface_wear).map_err(|error| ("counterface_wear", error))?,
            counterface: self
                .counterface
                .resolve()
                .map_err(|error| ("counterface", error.to_string()))?,
            sliding_friction: self.sliding_friction,
            stribeck_speed: si(&self.stribeck_speed).unwrap_or(STRIBECK_SPEED),
            friction_half_load: si(&self.friction_half_load),
            friction_map: self.friction_map.clone(),
            pad: self.pad.as_ref().map(PadSection::resolve),
            ..FaceProperties::default()
        })
    }

    /// Returns the rows of its tables.
    pub(crate) fn rows(&self) -> usize {
        let surfaces = [&self.wedge_surface, &self.counterface].map(Surface::rows);
        let maps = self.wedge_wear.iter().chain(&self.counterface_wear);
        surfaces.iter().sum::<usize>() + maps.map(|map| map.rows.len()).sum::<usize>()
    }

    /// Returns the files of its tables.
    pub(crate) fn files_mut(&mut self) -> impl Iterator<Item = &mut Option<String>> {
        let surfaces = [&mut self.wedge_surface, &mut self.counterface];
        let tables = surfaces.into_iter().filter_map(Surface::table_mut);
        let maps = self.wedge_wear.iter_mut().chain(&mut self.counterface_wear);
        let maps = maps.map(|map| &mut map.file);
        tables.map(|table| &mut table.file).chain(maps)
    }
}

/// Returns a map of depths, SI.
fn depths(table: &Option<QuantityTable<3>>) -> Result<Option<DepthMap>, String> {
    let Some(table) = table else { return Ok(None) };
    let rows = table.rows.iter();
    let points: Vec<[f64; 3]> = rows.map(|row| row.each_ref().map(Quantity::to_si)).collect();
    DepthMap::new(&points)
        .map(Some)
        .map_err(|error| error.to_string())
}
