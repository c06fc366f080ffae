//! The data of the interactive page: what the table holds, and a scene that moves as the mechanics does.

use std::collections::BTreeMap;

use quantity::System as Units;
use report::figures::{self, CaseOutcome};
use report::view::View;
use report::view::run::{Detail, Recording};
use serde_json::Value;
use study::case::builtin;
use study::half_truck::catalog;
use study::half_truck::{HalfTruckResult, run as run_truck};
use study::run::Run;

/// Runs a case to its end, which figures need, or for a short time.
fn outcome(name: &str, set: &[&str]) -> CaseOutcome {
    let set: Vec<String> = set.iter().map(|text| (*text).to_owned()).collect();
    let case = builtin::case_with(name, &set).unwrap();
    let result = Run::new(&case).unwrap().finish(|_| ());
    (case, result)
}

fn full(outcomes: &[CaseOutcome]) -> Vec<Recording> {
    let record = |outcome| Recording::of_wedge(outcome, Detail::Full);
    outcomes.iter().map(record).collect()
}

/// Returns the document as another program reads it.
fn document(outcomes: &[CaseOutcome]) -> Value {
    let exhibits: Vec<_> = outcomes.iter().flat_map(figures::run::exhibits).collect();
    let json = View::new(Units::Us, full(outcomes), &exhibits).to_json().unwrap();
    assert!(!json.contains('<'), "it stands in a script element");
    serde_json::from_str(&json).unwrap()
}

/// Little-endian 32-bit numbers.
fn decode(text: &str) -> Vec<f32> {
    bytes(text)
        .chunks_exact(4)
        .map(|four| f32::from_le_bytes(four.try_into().unwrap()))
        .collect()
}

/// Base64 by hand.
fn bytes(text: &str) -> Vec<u8> {
    let alphabet = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let digits: Vec<u32> = text
        .bytes()
        .filter(|letter| *letter != b'=')
        .map(|letter| alphabet.iter().position(|own| *own == letter).unwrap() as u32)
        .collect();
    let mut bytes = Vec::new();
    for group in digits.chunks(4) {
        let bits = group
            .iter()
            .enumerate()
            .fold(0, |bits, (k, digit)| bits | digit << (18 - 6 * k));
        bytes.extend_from_slice(&bits.to_be_bytes()[1..group.len()]);
    }
    bytes
}

fn list(document: &Value, place: &Value) -> Vec<f32> {
    let list = &document["data"][place.as_u64().unwrap() as usize];
    match list.as_str() {
        Some(text) => decode(text),
        None => summed(
            list["step"].as_f64().unwrap(),
            &bytes(list["differences"].as_str().unwrap()),
        ),
    }
}

/// Second differences by hand: seven bits a byte, the sign in the lowest one.
fn summed(step: f64, bytes: &[u8]) -> Vec<f32> {
    let (mut values, mut last, mut slope) = (Vec::new(), 0, 0);
    let (mut number, mut shift) = (0_i64, 0);
    for byte in bytes {
        number |= i64::from(byte & 127) << shift;
        shift += 7;
        if byte & 128 == 0 {
            slope += if number & 1 == 1 {
                -(number + 1) / 2
            } else {
                number / 2
            };
            last += slope;
            values.push((last as f64 * step) as f32);
            (number, shift) = (0, 0);
        }
    }
    values
}

/// Returns a run's columns, constant ones filled up.
fn columns(document: &Value, run: &Value) -> BTreeMap<String, Vec<f64>> {
    let rows = list(document, &run["time"]).len();
    let object = run["columns"].as_object().unwrap();
    object
        .iter()
        .map(|(name, column)| {
            let values = match column["value"].as_f64() {
                Some(value) => vec![value; rows],
                None => list(document, &column["data"])
                    .into_iter()
                    .map(f64::from)
                    .collect(),
            };
            (name.clone(), values)
        })
        .collect()
}

#[test]
fn columns_are_those_of_the_result() {
    let outcomes = [
        outcome("vdrun_toe_in_0.2_psi_0.012", &["simulation.duration=0.5 s"]),
        outcome("cdrun_toe_0_psi_0", &["simulation.duration=0.5 s"]),
    ];
    let document = document(&outcomes);
    assert_eq!(document["schema"], "wedgelab.view/1");
    for ((case, result), run) in outcomes.iter().zip(document["runs"].as_array().unwrap()) {
        assert_eq!(run["name"], case.name.as_str());
        let columns = columns(&document, run);
        assert!(columns.len() >= 60, "{}", columns.len());
        for (name, values) in &columns {
            let own = result.column(name).unwrap();
            assert_eq!(values.len(), own.len());
            for (found, wanted) in values.iter().zip(own) {
                let near = (found - wanted).abs() <= 1e-7 * wanted.abs() + 1e-37;
                assert!(near, "{name}: {found} is not {wanted}");
            }
        }
        for plot in run["plots"].as_array().unwrap() {
            for curve in plot["curves"].as_array().unwrap() {
                assert!(columns.contains_key(curve[0].as_str().unwrap()), "{curve}");
            }
        }
    }
}

type Triple = [f64; 3];

fn triple(value: &Value) -> Triple {
    std::array::from_fn(|k| value[k].as_f64().unwrap())
}

fn plus(a: Triple, b: Triple) -> Triple {
    std::array::from_fn(|k| a[k] + b[k])
}

/// Ry(pitch) Rz(yaw) Rx(roll) v, one turn after the other.
fn turned([roll, pitch, yaw]: Triple, [x, y, z]: Triple) -> Triple {
    let (s, c) = roll.sin_cos();
    let (y, z) = (c * y - s * z, s * y + c * z);
    let (s, c) = yaw.sin_cos();
    let (x, y) = (c * x - s * y, s * x + c * y);
    let (s, c) = pitch.sin_cos();
    [c * x + s * z, y, -s * x + c * z]
}

fn find<'v>(list: &'v Value, id: &Value) -> &'v Value {
    let list = list.as_array().unwrap();
    list.iter().find(|own| own["id"] == *id).unwrap()
}

/// Bodies placed by their columns, solids by their mounts, points and normals of contacts: together they must
/// give the gaps that the mechanics computed.
#[test]
fn the_scene_has_the_gaps_of_the_result() {
    for (name, set) in [
        ("vdrun_toe_out_0.2_psi_0", &["simulation.duration=1 s"][..]),
        ("vdrun_toe_in_0.2_psi_0.012", &["simulation.duration=1 s"]),
        ("cdrun_toe_in_0.2_psi_0.012", &["simulation.duration=0.5 s"]),
        (
            "cdrun_toe_0_psi_0",
            &[
                "simulation.duration=0.5 s",
                "simulation.start=touching",
                "bolster.yaw=0.3 deg",
                "bolster.roll=0.2 deg",
            ],
        ),
    ] {
        let outcomes = [outcome(name, set)];
        let document = document(&outcomes);
        let run = &document["runs"][0];
        let scene = &run["scene"];
        let columns = columns(&document, run);
        let pose = |body: &Value, row: usize| -> (Triple, Triple) {
            let at = |k: usize| {
                let name = body["coordinates"][k].as_str().unwrap();
                columns[name][row]
            };
            let place = plus(triple(&body["position"]), [at(0), at(1), at(2)]);
            (place, [at(3), at(4), at(5)])
        };
        let contacts = scene["contacts"].as_array().unwrap();
        assert_eq!(contacts.len(), 8);
        for contact in contacts {
            let gaps = &columns[contact["gap"].as_str().unwrap()];
            let body = find(&scene["bodies"], &contact["body"]);
            let solid = find(&scene["solids"], &contact["on"]);
            let under = find(&scene["bodies"], &solid["body"]);
            for row in (0..gaps.len()).step_by(7) {
                let (place, angles) = pose(body, row);
                let point = plus(place, turned(angles, triple(&contact["point"])));
                let (place, angles) = pose(under, row);
                let mount = plus(place, turned(angles, triple(&solid["mount"]["position"])));
                let normal = turned(
                    angles,
                    turned(triple(&solid["mount"]["angles"]), triple(&contact["normal"])),
                );
                let gap: f64 = (0..3).map(|k| (point[k] - mount[k]) * normal[k]).sum();
                // Columns have seven digits.
                let near = (gap - gaps[row]).abs() < 2e-7;
                assert!(
                    near,
                    "{name}, {}, row {row}: {gap} is not {}",
                    contact["id"], gaps[row]
                );
            }
        }
    }
}

/// The points of contact are corners of the wedge's solid, and the surfaces are faces of theirs.
#[test]
fn contacts_are_corners_and_faces_of_solids() {
    let outcomes = [outcome("vdrun_toe_in_0.2_psi_0", &["simulation.duration=0.1 s"])];
    let document = document(&outcomes);
    let scene = &document["runs"][0]["scene"];
    let vertices = |id: &Value| -> Vec<Triple> {
        let solid = find(&scene["solids"], id);
        solid["vertices"].as_array().unwrap().iter().map(triple).collect()
    };
    let wedge = vertices(&Value::from("wedge"));
    for contact in scene["contacts"].as_array().unwrap() {
        let point = triple(&contact["point"]);
        let distance = |vertex: &Triple| -> f64 { (0..3).map(|k| (vertex[k] - point[k]).powi(2)).sum() };
        assert!(wedge.iter().any(|vertex| distance(vertex) < 1e-20), "{point:?}");
        let normal = triple(&contact["normal"]);
        let heights: Vec<f64> = vertices(&contact["on"])
            .iter()
            .map(|vertex| (0..3).map(|k| vertex[k] * normal[k]).sum())
            .collect();
        let on_face = heights.iter().filter(|height| height.abs() < 1e-12).count();
        assert_eq!(on_face, 4, "{heights:?}");
        assert!(
            heights.iter().all(|height| *height < 1e-12),
            "the solid lies behind its surface"
        );
    }
}

#[test]
fn figures_hold_their_curves_in_si() {
    let outcomes = [outcome("cdrun_toe_0_psi_0", &[])];
    let document = document(&outcomes);
    let (_, result) = &outcomes[0];
    let figure = &document["figures"]["cdrun_toe_0_psi_0_corner_forces"];
    let panel = &figure["panels"][0];
    assert_eq!(panel["x"]["quantity"], "time");
    assert_eq!(panel["y"]["quantity"], "force");
    assert_eq!(panel["y"]["name"], "force");
    let curve = &panel["curves"][0];
    assert_eq!(curve["label"], "lower right");
    let found = list(&document, &curve["y"]);
    let wanted = result.column("column_lower_right_normal_force").unwrap();
    assert_eq!(found.len(), wanted.len());
    for (found, wanted) in found.iter().zip(wanted) {
        assert!((f64::from(*found) - wanted).abs() <= 1e-6 * wanted.abs() + 1e-9);
    }
    let force = &document["quantities"]["force"];
    assert_eq!(
        (&force["us"], &force["si"]),
        (&Value::from("lbf"), &Value::from("N"))
    );
    let factor = force["us_from_si"].as_f64().unwrap();
    assert!((factor * 4.448_221_615_260_5 - 1.0).abs() < 1e-14);
}

/// Returns a half-truck's run of two seconds.
fn truck(name: &str, detail: Detail) -> (Value, HalfTruckResult) {
    let entry = catalog::entry(name).unwrap();
    let case = entry.case(&nucars::truck::Choices::default(), 2.0).unwrap();
    let result = run_truck::run(&case, |_| ()).unwrap();
    let view = View::new(Units::Us, [Recording::of_truck(&case, &result, None, detail)], []);
    (serde_json::from_str(&view.to_json().unwrap()).unwrap(), result)
}

/// Forces as the arrows show them: the wedges have no mass, so that those of column, slope and coil must be
/// in balance.
#[test]
fn the_forces_drawn_on_a_half_trucks_wedges_are_in_balance() {
    for name in [
        "nucars_69_variable_toe_out",
        "nucars_69_constant_toe_none",
        "nucars_69_variable_toe_out_yaw",
    ] {
        let (document, result) = truck(name, Detail::Full);
        let run = &document["runs"][0];
        let (scene, columns) = (&run["scene"], columns(&document, run));
        let contacts = scene["contacts"].as_array().unwrap();
        assert_eq!(contacts.len(), 8, "two at each of four wedges");
        for wedge in ["wedge_127", "wedge_128", "wedge_129", "wedge_130"] {
            let own: Vec<&Value> = contacts
                .iter()
                .filter(|contact| contact["body"] == wedge)
                .collect();
            let coil = &columns[&format!("{wedge}_coil_force")];
            let mut pressed = 0;
            for row in (0..coil.len()).step_by(3) {
                if columns[&format!("{wedge}_jammed")][row] > 0.0 {
                    continue;
                }
                let mut sum = [0.0, 0.0, coil[row]];
                let mut size = coil[row].abs();
                for contact in &own {
                    let solid = find(&scene["solids"], &contact["on"]);
                    let normal = turned(triple(&solid["mount"]["angles"]), triple(&contact["normal"]));
                    let force = columns[contact["normal_force"].as_str().unwrap()][row];
                    let friction = [0, 1, 2].map(|k| columns[contact["friction"][k].as_str().unwrap()][row]);
                    sum = plus(plus(sum, normal.map(|part| part * force)), friction);
                    size = size.max(force);
                }
                // Friction at the column is drawn upright, 0.2 degrees off; across the track the pocket holds
                // the wedge.
                assert!(
                    sum[0].abs() < 2e-3 * size + 1e-3 && sum[2].abs() < 2e-3 * size + 1e-3,
                    "{name}, {wedge}, row {row}: {sum:?} of {size}"
                );
                pressed += usize::from(size > 1000.0);
            }
            assert!(pressed > 10, "{name}, {wedge} is pressed");
        }
        let rises = result.column("wedge_127_rise").unwrap();
        assert!(
            rises.iter().any(|rise| rise.abs() > 0.0),
            "{name}: it rises in its pocket"
        );
    }
}

#[test]
fn a_half_trucks_scene_has_its_bodies_wedges_and_springs_and_all_their_columns() {
    for name in ["nucars_68_variable_toe_in", "nucars_69_constant_toe_out"] {
        let (document, result) = truck(name, Detail::Thinned);
        let run = &document["runs"][0];
        let (scene, columns) = (&run["scene"], columns(&document, run));
        let names = |what: &str| -> Vec<&str> {
            let all = scene[what].as_array().unwrap().iter();
            all.map(|own| own["id"].as_str().unwrap()).collect()
        };
        assert_eq!(
            names("bodies"),
            [
                "body_1",
                "body_3",
                "body_4",
                "wedge_127",
                "wedge_128",
                "wedge_129",
                "wedge_130"
            ]
        );
        for side_frame in ["body_3", "body_4"] {
            for part in ["seat", "chord"] {
                find(&scene["solids"], &Value::from(format!("{side_frame}_{part}")));
            }
        }
        // Eight springs, four control coils.
        assert_eq!(scene["coils"].as_array().unwrap().len(), 12);
        for contact in scene["contacts"].as_array().unwrap() {
            for key in ["normal_force", "state"] {
                assert!(columns.contains_key(contact[key].as_str().unwrap()), "{contact}");
            }
            for k in 0..3 {
                assert!(
                    columns.contains_key(contact["friction"][k].as_str().unwrap()),
                    "{contact}"
                );
            }
            find(&scene["solids"], &contact["on"]);
        }
        for (name, values) in columns {
            let Some(own) = result.column(&name) else { continue };
            let most = own.iter().fold(0.0, |most: f64, value| most.max(value.abs()));
            assert_eq!(values.len(), own.len());
            for (found, wanted) in values.iter().zip(own) {
                assert!(
                    (found - wanted).abs() <= 3.1e-5 * most,
                    "{name}: {found} is not {wanted}"
                );
            }
        }
    }
}

/// Thinned: every n-th row, at its own time.
#[test]
fn a_long_run_is_thinned_to_rows_of_its_table() {
    let outcome = outcome(
        "cdrun_toe_0_psi_0",
        &["simulation.duration=3 s", "simulation.output_interval=0.001 s"],
    );
    let view = View::new(Units::Us, [Recording::of_wedge(&outcome, Detail::Thinned)], []);
    let document: Value = serde_json::from_str(&view.to_json().unwrap()).unwrap();
    let run = &document["runs"][0];
    let (times, columns) = (list(&document, &run["time"]), columns(&document, run));
    assert_eq!(times.len(), 1001);
    let own = outcome.1.column("wedge_z").unwrap();
    for (row, time) in times.iter().enumerate() {
        assert!((f64::from(*time) - 0.003 * row as f64).abs() < 1e-6);
        assert!((columns["wedge_z"][row] - own[3 * row]).abs() < 3.1e-5 * 0.0254 * 1.1);
    }
}
