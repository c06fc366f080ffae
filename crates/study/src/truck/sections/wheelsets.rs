//! Wheelsets and adapters.

use truck::{Adapter, FrictionAdapter, Geometry, Parameters, Wheelsets};

use super::{TURNS_ABOUT, friction};
use crate::case::problem::Problem;
use crate::case::read::contact;
use crate::case::section::Names;
use crate::reader::{CLEARANCE, CaseReader, DAMPING, LENGTH, PRELOAD, STIFFNESS};

/// Kinds of adapters.
#[derive(Clone, Copy, PartialEq)]
enum AdapterKind {
    Friction,
    Pad,
    Nothing,
}

pub(in crate::truck) fn wheelsets(r: &mut CaseReader<'_>, parameters: &mut Parameters) {
    let mut wheelsets = Wheelsets {
        pitching: true,
        motions: std::array::from_fn(|_| wedge::parameters::NeighbourMotion::fixed()),
        adapter: Adapter::friction(),
    };
    r.section(
        "wheelset",
        "Both wheelsets, prescribed; [leading_wheelset] and [trailing_wheelset] set one.",
    );
    r.motions(&mut wheelsets.motions[0], false, TURNS_ABOUT);
    wheelsets.motions[1] = wheelsets.motions[0].clone();
    for (name, own) in ["leading_wheelset", "trailing_wheelset"]
        .into_iter()
        .zip(&mut wheelsets.motions)
    {
        if r.overlay(name, "One wheelset: what is not given is as in [wheelset].") {
            r.motions(own, false, TURNS_ABOUT);
        }
    }
    const KINDS: Names<AdapterKind> = &[
        ("friction", AdapterKind::Friction),
        ("pad", AdapterKind::Pad),
        ("nothing", AdapterKind::Nothing),
    ];
    let comment = "\"friction\": steel on steel; \"pad\": elastomeric; \"nothing\": wheelsets and adapters \
                   are left out";
    match read_adapter(r, KINDS, comment, &mut parameters.geometry) {
        Some(adapter) => wheelsets.adapter = adapter,
        None => {
            parameters.wheelsets = None;
            for (name, own) in ["left_side_frame", "right_side_frame"]
                .iter()
                .zip(&parameters.side_frames)
            {
                if own.free.contains(&true) {
                    let message = format!("the {} has nothing to stand on", name.replace('_', " "));
                    let help = "write side_frame.free_coordinates = [] to prescribe its motion, or keep the \
                                adapters";
                    r.problem(
                        "adapter.kind",
                        Problem::new(message).label("no adapters").help(help),
                    );
                }
            }
            return;
        }
    }
    parameters.wheelsets = Some(wheelsets);
}

/// The section of the adapters of a truck that cannot do without.
pub(crate) fn adapter(r: &mut CaseReader<'_>, own: &mut Adapter, geometry: &mut Geometry) {
    const KINDS: Names<AdapterKind> = &[("friction", AdapterKind::Friction), ("pad", AdapterKind::Pad)];
    let comment = "\"friction\": steel on steel; \"pad\": elastomeric";
    if let Some(adapter) = read_adapter(r, KINDS, comment, geometry) {
        *own = adapter;
    }
}

/// Returns the section of the adapters; `None` if there are none.
fn read_adapter(
    r: &mut CaseReader<'_>,
    kinds: Names<AdapterKind>,
    comment: &str,
    geometry: &mut Geometry,
) -> Option<Adapter> {
    r.section("adapter", "Where side frames stand on the bearings.");
    let mut kind = AdapterKind::Friction;
    r.choice("kind", kinds, &mut kind, comment);
    let mut own = match kind {
        AdapterKind::Friction => Adapter::friction(),
        AdapterKind::Pad => Adapter::pad(),
        AdapterKind::Nothing => return None,
    };
    super::geometry::adapter(r, geometry, matches!(own, Adapter::Friction(_)));
    adapter_keys(r, &mut own);
    Some(own)
}

/// The keys of an adapter of its kind in the current section.
pub(crate) fn adapter_keys(r: &mut CaseReader<'_>, adapter: &mut Adapter) {
    match adapter {
        Adapter::Friction(adapter) => friction_adapter(r, adapter),
        Adapter::Pad(pad) => {
            r.quantity(
                "preload",
                PRELOAD,
                &mut pad.preload,
                "of an adapter in the nominal layout",
            );
            r.quantity(
                "stiffness",
                STIFFNESS,
                &mut pad.stiffness,
                "vertical: as steel, a guess",
            );
            let comment = "along and across: the least of claim 32 of US patent 9,637,143";
            r.quantity("shear_stiffness", STIFFNESS, &mut pad.shear_stiffness, comment);
            let comment = "of its two springs: yaw stiffness is the shear stiffness times its square";
            r.quantity("half_distance", LENGTH, &mut pad.half_distance, comment);
            r.quantity(
                "damping",
                DAMPING,
                &mut pad.damping,
                "of every direction: a guess",
            );
        }
    }
}

fn friction_adapter(r: &mut CaseReader<'_>, adapter: &mut FrictionAdapter) {
    let FrictionAdapter {
        preload,
        contact: own,
        friction: law,
        longitudinal,
        lateral,
    } = adapter;
    r.quantity(
        "preload",
        PRELOAD,
        preload,
        "of each of the two points in the nominal layout",
    );
    contact(r, own, "of each of the two points");
    friction(r, law);
    let comment = "to each side; 0.0468 in allow 30 mrad of yaw";
    r.quantity(
        "longitudinal_clearance",
        CLEARANCE,
        &mut longitudinal.clearance,
        comment,
    );
    r.quantity(
        "longitudinal_stiffness",
        STIFFNESS,
        &mut longitudinal.stiffness,
        "of each of the two stops",
    );
    r.quantity(
        "longitudinal_damping",
        DAMPING,
        &mut longitudinal.damping,
        "the same",
    );
    r.quantity(
        "lateral_clearance",
        CLEARANCE,
        &mut lateral.clearance,
        "to each side",
    );
    r.quantity(
        "lateral_stiffness",
        STIFFNESS,
        &mut lateral.stiffness,
        "of the stop",
    );
    r.quantity("lateral_damping", DAMPING, &mut lateral.damping, "the same");
}
