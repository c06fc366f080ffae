//! Reading the laws of connections: characteristics and piecewise linear functions.

use std::collections::HashMap;

use super::fields::{Fields, Stop};
use crate::finding::Severity;
use crate::number;
use crate::source::{At, Spanned};
use crate::tree::{Characteristic, Connection, Element, Law, PiecewiseLinear, Toe, UnknownValue};

/// The form of a characteristic, by the type of connection that uses it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LawForm {
    Limits,
    Gap,
    ViscousWedge,
    ViscousToeWedge,
    SurfaceFriction,
    StickSlipWedge,
    StickSlipWedge3d,
}

impl LawForm {
    fn of(element: &Element) -> Self {
        match element {
            Element::Parallel(_) | Element::ParallelGroup(_) | Element::CoilGroup(_) => LawForm::Limits,
            Element::Gap(_) => LawForm::Gap,
            Element::ViscousWedge(_) => LawForm::ViscousWedge,
            Element::SurfaceFriction(_) => LawForm::SurfaceFriction,
            Element::ViscousToeWedge(_) => LawForm::ViscousToeWedge,
            Element::StickSlipWedge(_) => LawForm::StickSlipWedge,
            Element::StickSlipWedge3d(_) => LawForm::StickSlipWedge3d,
        }
    }

    /// Returns the number of values that follow the record's number.
    fn values(self) -> usize {
        match self {
            LawForm::Limits | LawForm::Gap => 4,
            LawForm::ViscousWedge => 6,
            LawForm::ViscousToeWedge => 8,
            LawForm::SurfaceFriction => 5,
            LawForm::StickSlipWedge | LawForm::StickSlipWedge3d => 10,
        }
    }
}

/// Returns the form of each characteristic that is used, by the greater number of uses.
pub fn forms(connections: &[Connection]) -> HashMap<u32, LawForm> {
    let mut uses: HashMap<u32, Vec<(LawForm, u32)>> = HashMap::new();
    for connection in connections {
        let form = LawForm::of(&connection.element);
        for characteristic in connection.element.characteristics() {
            let counts = uses.entry(**characteristic).or_default();
            match counts.iter_mut().find(|(count, _)| *count == form) {
                Some((_, count)) => *count += 1,
                None => counts.push((form, 1)),
            }
        }
    }
    let most = |counts: Vec<(LawForm, u32)>| {
        // The first of several with equal numbers.
        let first = counts.first().copied()?;
        let best = counts
            .into_iter()
            .fold(first, |best, count| if count.1 > best.1 { count } else { best });
        Some(best.0)
    };
    uses.into_iter()
        .filter_map(|(id, counts)| Some((id, most(counts)?)))
        .collect()
}

/// Returns a record of `\CHARACTERISTIC DATA`.
pub fn characteristic(
    fields: &mut Fields<'_, '_>,
    forms: &HashMap<u32, LawForm>,
) -> Result<Characteristic, Stop> {
    fields.begin("characteristic", 0, 1);
    let id = fields.key("number")?;
    fields.identify(*id);
    let law = match forms.get(&*id) {
        None => unused(fields),
        Some(form) => {
            fields.expect_more(form.values() as u32);
            law(fields, *form)?
        }
    };
    let span = fields.span();
    fields.end_of_record(
        Severity::Error,
        "its form follows from the type of the connection that uses it: correct the type, or the values",
    );
    Ok(Characteristic {
        id,
        law,
        span: At(span),
    })
}

fn toe(fields: &mut Fields<'_, '_>) -> Result<Spanned<Toe>, Stop> {
    let out = fields.logical("toe (.T. out, .F. in)")?;
    Ok(Spanned::new(if *out { Toe::Out } else { Toe::In }, out.span))
}

fn law(fields: &mut Fields<'_, '_>, form: LawForm) -> Result<Law, Stop> {
    const STIFFNESS: &str = "function of the stiffness (0 if there is none)";
    const DAMPING: &str = "function of the damping (0 if there is none)";
    const COIL: &str = "function of the coil (0 if its force is constant)";
    const ANGLE: &str = "wedge angle (degrees)";
    const FORCE: &str = "force of the coil (lb)";
    const KA: &str = "Ka (lb/in)";
    const CA: &str = "Ca (lb·s/in)";
    Ok(match form {
        LawForm::Limits => Law::Limits {
            stiffness: fields.whole(STIFFNESS)?,
            damping: fields.whole(DAMPING)?,
            extension: fields.number("limit in extension (lb or in·lb)")?,
            compression: fields.number("limit in compression (lb or in·lb)")?,
        },
        LawForm::Gap => Law::Gap {
            stiffness: fields.whole(STIFFNESS)?,
            damping: fields.whole(DAMPING)?,
            high: fields.number("upper end of the gap (in)")?,
            low: fields.number("lower end of the gap (in)")?,
        },
        LawForm::ViscousWedge => Law::ViscousWedge {
            coil: fields.whole(COIL)?,
            damping: fields.whole(DAMPING)?,
            angle: fields.number(ANGLE)?,
            force: fields.number(FORCE)?,
            viscosity: fields.number("LVB (lb·s/in)")?,
            friction: fields.number("coefficient of friction")?,
        },
        LawForm::ViscousToeWedge => Law::ViscousToeWedge {
            coil: fields.whole(COIL)?,
            damping: fields.whole(DAMPING)?,
            angle: fields.number(ANGLE)?,
            force: fields.number(FORCE)?,
            viscosity: fields.number("LVB (lb·s/in)")?,
            slope_friction: fields.number("Mu1 (slope)")?,
            column_friction: fields.number("Mu2 (column)")?,
            toe: toe(fields)?,
        },
        LawForm::SurfaceFriction => Law::SurfaceFriction {
            normal: fields.whole("function of the normal force")?,
            damping: fields.whole(DAMPING)?,
            stiffness: fields.number(KA)?,
            bristle_damping: fields.number(CA)?,
            friction: fields.number("coefficient of friction")?,
        },
        LawForm::StickSlipWedge => Law::StickSlipWedge {
            coil: fields.whole(COIL)?,
            damping: fields.whole(DAMPING)?,
            angle: fields.number(ANGLE)?,
            force: fields.number(FORCE)?,
            stiffness: fields.number(KA)?,
            bristle_damping: fields.number(CA)?,
            slope_friction: fields.number("Mu1 (slope)")?,
            column_friction: fields.number("Mu2 (column)")?,
            toe: toe(fields)?,
            normal_limit: fields.number("FWNMAX (lb)")?,
        },
        LawForm::StickSlipWedge3d => Law::StickSlipWedge3d {
            coil: fields.whole("function of the coil")?,
            face: fields.whole("function of the column's face")?,
            angle: fields.number(ANGLE)?,
            variable: fields.logical("V/C (.T. variable, .F. constant)")?,
            stiffness: fields.number(KA)?,
            bristle_damping: fields.number(CA)?,
            slope_friction: fields.number("Mu1 (slope)")?,
            column_friction: fields.number("Mu2 (column)")?,
            direction: fields.number("XDIR (1 leading, -1 trailing)")?,
            normal_limit: fields.number("FWNMAX (lb)")?,
        },
    })
}

/// Returns the rest of the line of a characteristic that no connection uses.
fn unused(fields: &mut Fields<'_, '_>) -> Law {
    let mut values = Vec::new();
    while let Some(token) = fields.cursor.peek().filter(|token| !token.begins_line) {
        let text = fields.text_of(token);
        let number = number::real(text).map(UnknownValue::Number);
        let Some(value) = number.or_else(|| number::logical(text).map(UnknownValue::Logical)) else {
            break;
        };
        fields.cursor.next();
        fields.extend_span(token.span);
        values.push(Spanned::new(value, token.span));
    }
    Law::Unused { values }
}

/// Returns a record of `\PWL DATA`.
pub fn piecewise_linear(fields: &mut Fields<'_, '_>) -> Result<PiecewiseLinear, Stop> {
    fields.begin("function", 0, 2);
    let id = fields.key("number")?;
    fields.identify(*id);
    let count = fields.key("number of points")?;
    let points = *count;
    // The wrong count is distinguished from missing values by `Wrap::Counted`.
    fields.expect_more(points.saturating_mul(2));
    // A file can claim any number of points.
    let room = (points as usize).min(4096).min(fields.cursor.remaining());
    let mut list = |what: &str| -> Result<Vec<Spanned<f64>>, Stop> {
        let mut values = Vec::with_capacity(room);
        for _ in 0..points {
            values.push(fields.number(what)?);
        }
        Ok(values)
    };
    let ordinates = list("next ordinate")?;
    let abscissae = list("next abscissa")?;
    let span = fields.span();
    let help = format!("it says {points} points, which are {points} ordinates and then {points} abscissae");
    if !fields.end_of_record(Severity::Error, &help) {
        return Err(Stop);
    }
    Ok(PiecewiseLinear {
        id,
        ordinates,
        abscissae,
        span: At(span),
    })
}
