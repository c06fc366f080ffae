//! Center plates, side bearings, adapters: with the keys that trucks have.

use std::sync::Arc;

use quantity::Kind;
use truck::{Adapter, CarBody, Lading, SideBearings};
use vehicle::catalog::{AxleAdapter, Bearing, CatalogElement, Plate};

use super::ElementKind;
use crate::case::field::Reach;
use crate::case::section::Range;
use crate::reader::{CLEARANCE, CaseReader, PRELOAD, QuantityForm};
use crate::truck::sections::{adapter_keys, bearing_keys, doubts_of_bearing, plate_keys};

/// The keys of a center plate, a side bearing or an adapter; a is the body above.
/// Returns the element and what is doubtful.
pub(super) fn seat(
    r: &mut CaseReader<'_>,
    path: &str,
    kind: ElementKind,
) -> (Arc<dyn CatalogElement>, Vec<String>) {
    if let ElementKind::RollerSideBearing = kind {
        return bearing(r, SideBearings::rollers());
    }
    if let ElementKind::ConstantContactSideBearing = kind {
        return bearing(r, SideBearings::constant_contact());
    }
    (without_doubts(r, path, kind), Vec::new())
}

fn without_doubts(r: &mut CaseReader<'_>, path: &str, kind: ElementKind) -> Arc<dyn CatalogElement> {
    match kind {
        ElementKind::CenterPlate => {
            let usual = CarBody::new(Lading::Loaded, SideBearings::rollers());
            let mut own = Plate {
                plate: usual.center_plate,
                load: 0.0,
            };
            r.quantity("load", PRELOAD, &mut own.load, "in the nominal layout");
            plate_keys(r, path, &mut own.plate);
            Arc::new(own)
        }
        ElementKind::AdapterPad => adapter(r, Adapter::pad(), [0.0; 2]),
        _ => {
            let form: QuantityForm = (Kind::Length, Range::NotNegative, Reach::FromZero(0.1));
            let mut across = truck::Geometry::default().adapter;
            let comment = "from its middle across to each of its two points";
            r.quantity("point_distance", form, &mut across[0], comment);
            let comment = "and to each of its two longitudinal stops";
            r.quantity("stop_distance", CLEARANCE, &mut across[1], comment);
            adapter(r, Adapter::friction(), across)
        }
    }
}

fn bearing(r: &mut CaseReader<'_>, usual: SideBearings) -> (Arc<dyn CatalogElement>, Vec<String>) {
    let mut own = usual.kind;
    bearing_keys(r, &mut own);
    let doubts = doubts_of_bearing(&own);
    (Arc::new(Bearing(own)), doubts)
}

fn adapter(r: &mut CaseReader<'_>, usual: Adapter, across: [f64; 2]) -> Arc<dyn CatalogElement> {
    let mut adapter = usual;
    adapter_keys(r, &mut adapter);
    Arc::new(AxleAdapter { adapter, across })
}
