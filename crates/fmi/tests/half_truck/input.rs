//! Loads, starts and everything that is refused.

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::half_truck::{HalfTruck, RESOURCE};
use fmi::instance::Instance;
use fmi::source::{FmuModel, Source};
use fmi::{limits, resources};
use nucars::file_sets::{Instead, RunFiles, Text};
use serde_json::{Value, json};
use study::case::builtin;

use super::{NAME, Part, half_truck, settings};

/// The variables that the truck without wedges has had since it can be exported.
#[test]
fn names_of_the_truck_without_wedges_stay() {
    let case = builtin::case("cdrun_toe_out_0.2_psi_0.012").unwrap();
    let source = Source::of_case(FmuModel::Truck, case).unwrap();
    let description = Description::new(&source).unwrap();
    let own = description.variables.iter().map(|variable| {
        let variability = format!("{:?}", variable.variability).to_lowercase();
        format!("{} {} {variability}", variable.name, variable.causality.name())
    });
    let known: Vec<&str> = include_str!("../truck_variables.txt").lines().collect();
    assert_eq!(own.collect::<Vec<_>>(), known);
}

#[test]
fn variables_have_names_of_their_own_and_states_are_outputs() {
    for name in [NAME, "nucars_68_variable_toe_in_yaw"] {
        let part = Part::of(half_truck(name, 1.0), Interface::CoSimulation);
        let mut names: Vec<&str> = part.description.variables.iter().map(|own| &*own.name).collect();
        for wanted in [
            "force_on_body_1_z",
            "moment_on_body_3_yaw",
            "wedge_127_column_normal_force",
            "wedge_127_state",
            "wedge_127_event_indicator",
            "input_vertical",
            "load_work",
            "ledger_relative_residual",
        ] {
            assert!(names.contains(&wanted), "{wanted}");
        }
        let count = names.len();
        names.sort_unstable();
        names.dedup();
        assert_eq!(names.len(), count);
        let xml = part.description.xml(Version::Two).unwrap();
        assert!(xml.contains(r#"providesDirectionalDerivative="false""#), "{name}");
        let state = part.reference("body_1_z") + 1;
        // In FMI 2.0 variables are counted from 1; the state depends on itself.
        assert!(xml.contains(&format!(r#"<Unknown index="{state}" dependencies="{state}""#)));
        let xml = part.description.xml(Version::Three).unwrap();
        let state = state - 1;
        assert!(xml.contains(&format!(
            r#"<Output valueReference="{state}" dependencies="{state}""#
        )));
    }
}

#[test]
fn a_load_accelerates_its_body_alone_and_its_work_is_in_the_ledger() {
    let rates = |load: f64| {
        let mut part = Part::new(Interface::ModelExchange);
        part.set("force_on_body_1_z", load);
        part.begin();
        let mut rates = vec![0.0; part.description.entries.states.len()];
        part.instance.rates(&mut rates).unwrap();
        rates
    };
    let (without, with) = (rates(0.0), rates(1000.0));
    let mut part = Part::new(Interface::CoSimulation);
    let body = part.number_of_body(1);
    let mass = half_truck(NAME, 1.0).case().truck.model.bodies[body].mass;
    let states = part.description.entries.states.iter();
    let place = states
        .clone()
        .position(|state| state.name == "body_1_z_rate")
        .unwrap();
    for (k, (with, without)) in with.iter().zip(&without).enumerate() {
        if k == place {
            assert!(((with - without) * mass / 1000.0 - 1.0).abs() < 1e-9);
        } else {
            assert_eq!(with.to_bits(), without.to_bits());
        }
    }
    part.instance.set_experiment(0.0, None, Some(1e-7)).unwrap();
    part.begin();
    for step in 0..200 {
        let time = f64::from(step) * 1e-3;
        part.set("force_on_body_1_z", 5e5 * (40.0 * time).sin());
        part.set("moment_on_body_1_roll", 3e4 * (25.0 * time).sin());
        part.step(1e-3);
    }
    let [work, relative, stored] =
        ["load_work", "ledger_relative_residual", "stored_energy_change"].map(|name| part.get(name));
    println!("{work} {relative} {stored}");
    assert!(work > 100.0, "{work}");
    assert!(relative < 1e-5, "{relative}");
}

#[test]
fn the_equilibrium_is_one() {
    let accelerations = |start: i32| {
        let mut part = Part::new(Interface::ModelExchange);
        part.choose("start", start);
        // At rest.
        let inputs: Vec<String> = part
            .description
            .entries
            .inputs
            .iter()
            .map(|own| own.name.clone())
            .collect();
        for name in inputs.iter().filter(|name| name.ends_with("_rate")) {
            part.set(name, 0.0);
        }
        part.begin();
        let mut rates = vec![0.0; part.description.entries.states.len()];
        part.instance.rates(&mut rates).unwrap();
        let states = part.description.entries.states.iter().zip(&rates);
        let own = states.filter(|(state, _)| state.name.ends_with("_rate"));
        own.fold(0.0_f64, |most, (_, rate)| most.max(rate.abs()))
    };
    let (drawn, rest) = (accelerations(0), accelerations(1));
    println!("{drawn} {rest}");
    assert!(rest < 1e-6 && drawn > 1e-3, "{drawn} {rest}");
}

#[test]
fn wrong_values_are_refused_and_nothing_changes() {
    let mut part = Part::new(Interface::CoSimulation);
    part.begin();
    part.step(1e-3);
    let before = part.instance.save();
    let load = part.reference("force_on_body_1_z");
    for value in [f64::NAN, f64::INFINITY] {
        let reason = part.instance.set_float(load, value).unwrap_err().message;
        assert!(
            reason.contains("force_on_body_1_z") && reason.contains("finite"),
            "{reason}"
        );
    }
    let motion = part.reference("motion");
    let reason = part.instance.set_integer(motion, 1).unwrap_err().message;
    assert!(reason.contains("fixed parameter"), "{reason}");
    let output = part.reference("wedge_127_coil_force");
    assert!(part.instance.set_float(output, 0.0).is_err());
    let (knowns, unknowns) = ([load], [part.reference("der(body_1_z_rate)")]);
    let reason = part
        .instance
        .directional_derivative(&unknowns, &knowns, &[1.0], &mut [0.0]);
    assert!(reason.unwrap_err().message.contains("no directional derivatives"));
    assert_eq!(part.instance.save(), before);
    // Under such a load steps would lead nowhere.
    let time = part.instance.time();
    part.instance.set_float(load, 1e118).unwrap();
    let reason = part.instance.do_step(time, 1e-3).unwrap_err().message;
    assert!(reason.contains("1e118, out of all proportion"), "{reason}");
    let mut part = Part::new(Interface::CoSimulation);
    let reason = part.instance.set_integer(motion, 2).unwrap_err().message;
    assert!(reason.contains("it goes from 0 to 1"), "{reason}");
}

/// Reads the resources of an FMU of a run.
fn read(text: &str) -> Result<Source, String> {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join(resources::MODEL), "HalfTruck\n").unwrap();
    std::fs::write(folder.path().join(RESOURCE), text).unwrap();
    resources::read(folder.path()).map_err(|error| error.message)
}

#[test]
fn resources_are_read_again_and_damaged_ones_are_refused_with_the_reason() {
    let good = half_truck(NAME, 1.0).text().to_owned();
    let Source::HalfTruck(again) = read(&good).unwrap() else {
        unreachable!("a half-truck was written")
    };
    assert_eq!(again.text(), good);
    let edited = |place: &str, value: Value| {
        let mut own: Value = serde_json::from_str(&good).unwrap();
        *own.pointer_mut(place).unwrap() = value;
        read(&own.to_string()).unwrap_err()
    };
    for (place, value, reason) in [
        ("/version", json!(2), "reads version 1"),
        ("/run/built_in", json!("nucars_7"), "no built-in run `nucars_7`"),
        ("/settings/relative_tolerance", json!(0.0), "between 0 and 1"),
        ("/settings/duration", json!(-1.0), "must be positive"),
        ("/settings/interval", json!(1e-300), "at most"),
        ("/settings/choices/speed", json!(-1.0), "`speed` is -1"),
        (
            "/settings/choices/wedges",
            json!("bodies"),
            "have massless wedges",
        ),
        ("/settings", json!({}), "missing field"),
    ] {
        let text = edited(place, value);
        assert!(
            text.contains(RESOURCE) && text.contains(reason),
            "{place}: {text}"
        );
        assert!(text.len() < 600, "{place}: {text}");
    }
    assert!(read("{").unwrap_err().contains("is damaged"));
    assert!(
        read(&" ".repeat(limits::RECORD_FILE as usize + 1))
            .unwrap_err()
            .contains("at most 64 MiB")
    );
}

#[test]
fn an_fmu_of_files_needs_no_files() {
    let folder = tempfile::tempdir().unwrap();
    let [run, ..] = [
        ["bolst_wedge_sf_bolst-vert-displ_69_const.run"; 2],
        ["bolst_wedge_sf_69_const.sys"; 2],
        ["bolst_displ_input3.inp"; 2],
        ["sngl_trk_69.dat", "sngl_trk.dat"],
    ]
    .map(|[name, as_named]| {
        let path = folder.path().join(as_named);
        std::fs::write(&path, nucars::builtin::source(name).unwrap().text()).unwrap();
        path
    });
    let files = RunFiles::read(&run, &Instead::default()).unwrap();
    assert!(!files.has_errors());
    let texts = files.texts();
    let folder_name = folder.path().to_str().unwrap().to_owned();
    drop(folder);
    let made = HalfTruck::of_files(texts.clone(), &settings(1.0)).unwrap();
    assert_eq!(made.case().name, "bolst_wedge_sf_bolst-vert-displ_69_const");
    assert!(!made.text().contains(&*folder_name), "folders are left out");
    let Source::HalfTruck(again) = read(made.text()).unwrap() else {
        unreachable!("a half-truck was written")
    };
    assert!(!again.case().requests.is_empty(), "those of the data file");
    let source = Source::HalfTruck(again);
    let mut instance = Instance::of("half", None, source, Version::Three, Interface::CoSimulation).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    instance.do_step(0.0, 1e-2).unwrap();

    let mut broken = texts;
    broken.system = Some(Text {
        name: "half.sys".to_owned(),
        text: "\\BODY DATA\nnonsense\n".to_owned(),
    });
    let reason = HalfTruck::of_files(broken, &settings(1.0)).unwrap_err().message;
    assert!(
        reason.contains("error(s), the first of which") && reason.contains("nucars check"),
        "{reason}"
    );
}
