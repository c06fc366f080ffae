//! Writing `.SYS` files.

use super::{Out, list, logical, quoted, real, reals};
use crate::source::Spanned;
use crate::tree::{Characteristic, Element, Law, SystemFile, Toe, UnknownValue};

pub fn write(file: &SystemFile) -> String {
    let mut out = Out::default();
    out.title("SYSTEM TITLE", &file.title);

    out.keyword("BODY DATA");
    out.line(&[&file.bodies.len()]);
    for body in &file.bodies {
        out.text(&format!(
            " {} {}{}",
            body.id,
            quoted(&body.name),
            reals(&body.position)
        ));
        let mass = [body.mass, body.inertia[0], body.inertia[1], body.inertia[2]];
        out.text(&format!(
            "   {}{}{}",
            body.dofs.len(),
            list(&body.dofs),
            reals(&mass)
        ));
    }

    if !file.input_bodies.is_empty() {
        out.keyword("INPUT BODY DATA");
        out.line(&[&file.input_bodies.len()]);
    }
    for body in &file.input_bodies {
        out.text(&format!(
            " {} {}{} {}{}{} {}",
            body.id,
            quoted(&body.name),
            reals(&body.position),
            body.dofs.len(),
            list(&body.dofs),
            list(&body.histories),
            logical(*body.lag)
        ));
    }

    out.keyword("CONNECTION DATA");
    out.line(&[&file.connections.len()]);
    for connection in &file.connections {
        out.text(&format!(
            " {} {} {} {} {}{} {}",
            connection.id,
            quoted(&connection.name),
            connection.element.code(),
            connection.body_a,
            connection.body_b,
            reals(&connection.position),
            tail(&connection.element)
        ));
    }

    out.keyword("CHARACTERISTIC DATA");
    for characteristic in &file.characteristics {
        out.text(&law(characteristic));
    }

    out.keyword("PWL DATA");
    for function in &file.piecewise_linear {
        out.text(&format!(
            " {} {}{}",
            function.id,
            function.ordinates.len(),
            reals(&function.ordinates)
        ));
        out.text(&format!("    {}", reals(&function.abscissae)));
    }
    out.others(&file.other);
    out.0
}

fn tail(element: &Element) -> String {
    let (dofs, characteristics) = (list(element.dofs()), list(element.characteristics()));
    match element {
        Element::ParallelGroup(_) | Element::CoilGroup(_) => {
            format!("{}{dofs}{characteristics}", element.dofs().len())
        }
        _ => format!("{}{characteristics}", dofs.trim_start()),
    }
}

fn toe(toe: Spanned<Toe>) -> &'static str {
    logical(*toe == Toe::Out)
}

fn law(characteristic: &Characteristic) -> String {
    let id = characteristic.id;
    match &characteristic.law {
        Law::Limits {
            stiffness,
            damping,
            extension,
            compression,
        } => format!(
            " {id} {stiffness} {damping}{}",
            reals(&[*extension, *compression])
        ),
        Law::Gap {
            stiffness,
            damping,
            high,
            low,
        } => format!(" {id} {stiffness} {damping}{}", reals(&[*high, *low])),
        Law::ViscousWedge {
            coil,
            damping,
            angle,
            force,
            viscosity,
            friction,
        } => format!(
            " {id} {coil} {damping}{}",
            reals(&[*angle, *force, *viscosity, *friction])
        ),
        Law::ViscousToeWedge {
            coil,
            damping,
            angle,
            force,
            viscosity,
            slope_friction,
            column_friction,
            toe: leans,
        } => format!(
            " {id} {coil} {damping}{} {}",
            reals(&[*angle, *force, *viscosity, *slope_friction, *column_friction]),
            toe(*leans)
        ),
        Law::SurfaceFriction {
            normal,
            damping,
            stiffness,
            bristle_damping,
            friction,
        } => format!(
            " {id} {normal} {damping}{}",
            reals(&[*stiffness, *bristle_damping, *friction])
        ),
        Law::StickSlipWedge {
            coil,
            damping,
            angle,
            force,
            stiffness,
            bristle_damping,
            slope_friction,
            column_friction,
            toe: leans,
            normal_limit,
        } => format!(
            " {id} {coil} {damping}{} {}{}",
            reals(&[
                *angle,
                *force,
                *stiffness,
                *bristle_damping,
                *slope_friction,
                *column_friction
            ]),
            toe(*leans),
            reals(&[*normal_limit])
        ),
        Law::StickSlipWedge3d {
            coil,
            face,
            angle,
            variable,
            stiffness,
            bristle_damping,
            slope_friction,
            column_friction,
            direction,
            normal_limit,
        } => format!(
            " {id} {coil} {face} {} {}{}",
            real(**angle),
            logical(**variable),
            reals(&[
                *stiffness,
                *bristle_damping,
                *slope_friction,
                *column_friction,
                *direction,
                *normal_limit
            ])
        ),
        Law::Unused { values } => {
            let values: String = values
                .iter()
                .map(|value| match value.value {
                    UnknownValue::Number(number) => format!(" {}", real(number)),
                    UnknownValue::Logical(truth) => format!(" {}", logical(truth)),
                })
                .collect();
            format!(" {id}{values}")
        }
    }
}
