//! Issue 29: saved instances edited by hand, and files that fill the memory, are refused with a reason.

#[path = "../../../integrate/tests/common/damage.rs"]
mod damage;

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::thread;

use fmi::description::{Description, Version};
use fmi::element::Interface;
use fmi::half_truck::HalfTruck;
use fmi::instance::{Instance, Phase, Saved};
use fmi::source::{FmuModel, Source};
use fmi::{limits, package, resources};
use serde_json::{Value, json};
use study::case::{Case, builtin};
use study::half_truck::files::Settings;
use zip::ZipWriter;
use zip::write::SimpleFileOptions;

fn case() -> Case {
    builtin::case("cdrun_toe_out_0.2_psi_0.012").unwrap()
}

/// Returns the source of a model.
fn source(model: FmuModel) -> Source {
    let half_truck = || HalfTruck::built_in("nucars_69_constant_toe_out", &Settings::default()).unwrap();
    Source::of_case(model, case()).unwrap_or_else(|| Source::HalfTruck(Box::new(half_truck())))
}

/// Returns an instance on its way.
fn under_way(model: FmuModel, interface: Interface) -> Instance {
    let mut instance = Instance::of("wedge", None, source(model), Version::Two, interface).unwrap();
    instance.set_experiment(0.5, Some(100.0), Some(1e-6)).unwrap();
    instance.enter_initialization().unwrap();
    instance.exit_initialization().unwrap();
    match interface {
        Interface::CoSimulation => go_on(&mut instance, 10, 1e-3).unwrap(),
        Interface::ModelExchange => instance.enter_continuous_time_mode().unwrap(),
    }
    instance
}

fn go_on(instance: &mut Instance, steps: u32, length: f64) -> Result<(), fmi::Error> {
    let inputs = &instance.description().entries.inputs;
    let height = inputs
        .iter()
        .position(|entry| entry.name == "bolster_z")
        .unwrap_or(0);
    let input = instance
        .description()
        .reference(fmi::variable::VariableRole::Input(height))
        .unwrap();
    for _ in 0..steps {
        let time = instance.time();
        instance.set_float(input, 0.05 * (time - 0.5))?;
        instance.do_step(time, length)?;
    }
    Ok(())
}

/// Checks whether an instance answers, after a step if it makes steps.
fn use_it(instance: &mut Instance) -> Result<(), fmi::Error> {
    let references: Vec<u32> = instance
        .description()
        .variables
        .iter()
        .map(|own| own.reference)
        .collect();
    for reference in references.into_iter().step_by(11) {
        // Of another type, or an answer, or a reason.
        let _ = instance.get_float(reference);
        let _ = instance.get_integer(reference);
    }
    match instance.interface() {
        Interface::CoSimulation => go_on(instance, 1, 1e-6),
        Interface::ModelExchange => instance.enter_event_mode().and_then(|()| {
            let time = instance.time();
            instance.update_discrete_states()?;
            instance.set_time(time + 1e-6)
        }),
    }
}

#[test]
fn issue_029_every_member_of_an_instance_edited_by_hand_is_refused_or_goes_on() {
    thread::scope(|scope| {
        for (model, interface) in [
            (FmuModel::Wedge, Interface::CoSimulation),
            (FmuModel::Wedge, Interface::ModelExchange),
            (FmuModel::QuasiStatic, Interface::CoSimulation),
            (FmuModel::Truck, Interface::CoSimulation),
            (FmuModel::HalfTruck, Interface::CoSimulation),
            (FmuModel::HalfTruck, Interface::ModelExchange),
        ] {
            for half in [0, 1] {
                scope.spawn(move || every_other_member_is_refused_or_goes_on(model, interface, half));
            }
        }
    });
}

/// Of all edits those with even numbers are half 0, those with odd numbers half 1.
fn every_other_member_is_refused_or_goes_on(model: FmuModel, interface: Interface, half: usize) {
    let mut instance = under_way(model, interface);
    let good = instance.save();
    let saved: Value = serde_json::from_slice(&good.to_bytes().unwrap()).unwrap();
    let (mut refused, mut stopped, mut went_on) = (0, 0, 0);
    for (what, state) in damage::damaged(&saved).skip(half).step_by(2) {
        let bytes = serde_json::to_vec(&state).unwrap();
        let restored = Saved::from_bytes(&bytes).and_then(|state| instance.restore(&state));
        if let Err(error) = restored {
            assert!((10..1500).contains(&error.message.len()), "{what}: {error}");
            assert_eq!(instance.save(), good, "{what}: a refused state changes nothing");
            refused += 1;
            continue;
        }
        match use_it(&mut instance) {
            Ok(()) => went_on += 1,
            Err(error) => {
                assert!(error.message.len() > 10, "{what}");
                stopped += 1;
            }
        }
        instance.restore(&good).unwrap();
    }
    println!("{model:?} {interface:?}: {refused} refused, {stopped} stopped, {went_on} went on");
    assert!(
        refused > 150 && went_on > 25,
        "{model:?} {interface:?}: {refused} {stopped} {went_on}"
    );
    // As if nothing had been.
    let mut straight = under_way(model, interface);
    if interface == Interface::CoSimulation {
        go_on(&mut instance, 5, 1e-3).unwrap();
        go_on(&mut straight, 5, 1e-3).unwrap();
    }
    assert_eq!(instance.save(), straight.save());
}

#[test]
fn issue_029_members_of_an_instance_that_led_astray_are_refused_by_name() {
    let mut instance = under_way(FmuModel::Wedge, Interface::CoSimulation);
    let good: Value = serde_json::from_slice(&instance.save().to_bytes().unwrap()).unwrap();
    let integrator = "/element/system/integrator";
    for (place, value, member) in [
        // A step from there would have been 1e308 s long.
        ("/time".to_owned(), json!(1e308), "the element's time"),
        ("/time".to_owned(), json!(0.0), "the element's time"),
        ("/values/start_inputs".to_owned(), json!([0.0]), "start_inputs"),
        ("/phase".to_owned(), json!("Event"), "phase"),
        ("/phase".to_owned(), json!("Initialization"), "time"),
        ("/element".to_owned(), Value::Null, "element"),
        (
            "/values/past/1/time".to_owned(),
            json!(0.0),
            "the time of an earlier point",
        ),
        (
            "/values/past/2/time".to_owned(),
            json!(1.0),
            "the time of an earlier point",
        ),
        ("/values/doubts".to_owned(), json!([]), "doubts"),
        ("/values/set".to_owned(), json!([true]), "set"),
        ("/values/past/0/inputs".to_owned(), json!([1.0]), "past"),
        ("/values/inputs".to_owned(), json!([]), "inputs"),
        ("/values/options/0".to_owned(), json!(3), "coil_mode"),
        ("/values/options/2".to_owned(), json!(-1), "derive_rates"),
        ("/experiment/tolerance".to_owned(), json!(0.0), "tolerance is 0"),
        ("/experiment/stop".to_owned(), json!(0.25), "stop time is 0.25"),
        (
            format!("{integrator}/discrete_states/0"),
            json!(9),
            "contact state of the system",
        ),
        (
            format!("{integrator}/statistics/steps"),
            json!(u64::MAX),
            "statistics.steps",
        ),
    ] {
        let mut state = good.clone();
        *state.pointer_mut(&place).unwrap() = value;
        let saved = Saved::from_bytes(&serde_json::to_vec(&state).unwrap()).unwrap();
        let reason = instance
            .restore(&saved)
            .err()
            .unwrap_or_else(|| panic!("{place} was taken"));
        assert!(reason.message.contains(member), "{place}: {reason}");
    }
    let reason = Saved::from_bytes(&vec![b' '; limits::RECORD_FILE as usize + 1]).unwrap_err();
    assert!(reason.message.contains("at most 67108864 are read"), "{reason}");
}

/// Whoever read a value before the experiment was set up had an element that began at zero, and steps that
/// began there.
#[test]
fn issue_029_an_experiment_set_up_after_a_value_was_read_counts() {
    let instance = |reads: bool| {
        let mut instance = Instance::of_case(
            "wedge",
            None,
            FmuModel::Wedge,
            case(),
            Version::Two,
            Interface::CoSimulation,
        )
        .unwrap();
        let output = instance
            .description()
            .reference(fmi::variable::VariableRole::Output(0))
            .unwrap();
        if reads {
            instance.get_float(output).unwrap();
        }
        instance.set_experiment(0.5, None, Some(1e-7)).unwrap();
        instance.enter_initialization().unwrap();
        instance.exit_initialization().unwrap();
        go_on(&mut instance, 3, 1e-3).unwrap();
        instance
    };
    assert_eq!(instance(true).save(), instance(false).save());
    assert_eq!(instance(true).phase(), Phase::Step);
}

#[test]
fn issue_029_steps_that_are_lost_against_the_time_are_refused() {
    let mut instance = under_way(FmuModel::Truck, Interface::CoSimulation);
    let time = instance.time();
    let reason = instance.do_step(time, 1e-18).unwrap_err();
    assert!(reason.message.contains("make it longer"), "{reason}");
    assert_eq!(instance.phase(), Phase::Step);
    instance.do_step(time, 1e-4).unwrap();
}

/// Returns the folder `resources` of an FMU.
fn resources_of(folder: &Path) -> PathBuf {
    let description = Description::new(&Source::Wedge(Box::new(case()))).unwrap();
    fs::write(folder.join(fmi::source::CASE), &description.files[0].1).unwrap();
    fs::write(folder.join(resources::MODEL), "FrictionWedge\n").unwrap();
    folder.to_owned()
}

#[test]
fn issue_029_resources_that_fill_the_memory_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = resources_of(folder.path());
    resources::read(&path).unwrap();
    let reason = |file: &str, bytes: u64| {
        // It takes no room on the disk.
        let written = fs::OpenOptions::new().write(true).open(path.join(file)).unwrap();
        written.set_len(bytes).unwrap();
        resources::read(&path).unwrap_err().message
    };
    let text = reason(fmi::source::CASE, limits::TEXT_FILE + 1);
    assert!(
        text.contains("case.toml") && text.contains("at most 16 MiB are read"),
        "{text}"
    );
    let text = reason(resources::MODEL, limits::MODEL_FILE + 1);
    assert!(
        text.contains("model.txt") && text.contains("at most 1 KiB are read"),
        "{text}"
    );
    fs::write(path.join(resources::MODEL), "x".repeat(1000)).unwrap();
    let text = resources::read(&path).unwrap_err().message;
    assert!(
        text.contains("is no model of this library") && text.len() < 400,
        "{text}"
    );
    fs::write(path.join(resources::MODEL), [0xff]).unwrap();
    assert!(resources::read(&path).unwrap_err().message.contains("not UTF-8"));
    fs::remove_file(path.join(resources::MODEL)).unwrap();
    fs::create_dir(path.join(resources::MODEL)).unwrap();
    let text = resources::read(&path).unwrap_err().message;
    assert!(
        text.contains("is no file") && text.contains("unpacked `resources`"),
        "{text}"
    );
    #[cfg(target_os = "linux")]
    {
        fs::remove_dir(path.join(resources::MODEL)).unwrap();
        std::os::unix::fs::symlink("/dev/zero", path.join(resources::MODEL)).unwrap();
        assert!(resources::read(&path).unwrap_err().message.contains("is no file"));
    }
}

/// An archive with these files.
fn archive(path: &Path, files: &[(&str, &[u8])]) {
    let mut archive = ZipWriter::new(fs::File::create(path).unwrap());
    for (name, bytes) in files {
        archive.start_file(*name, SimpleFileOptions::default()).unwrap();
        archive.write_all(bytes).unwrap();
    }
    archive.finish().unwrap();
}

/// The archive with another length of its last file, which is what it unpacks to as it says.
fn pretend(path: &Path, length: u32) {
    let mut bytes = fs::read(path).unwrap();
    for (mark, offset) in [(b"PK\x03\x04", 22), (b"PK\x01\x02", 24)] {
        let at = bytes.windows(4).rposition(|four| four == mark).unwrap() + offset;
        bytes[at..at + 4].copy_from_slice(&length.to_le_bytes());
    }
    fs::write(path, bytes).unwrap();
}

#[test]
fn issue_029_fmus_that_cannot_be_merged_say_why() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name);
    let description: (&str, &[u8]) = ("modelDescription.xml", b"<fmiModelDescription/>");
    archive(
        &path("good.fmu"),
        &[description, ("binaries/linux64/w.so", b"\x7fELF")],
    );
    archive(
        &path("other.fmu"),
        &[description, ("binaries/win64/w.dll", b"MZ")],
    );
    let merged = |parts: &[PathBuf]| {
        let merged = package::merged(parts).map_err(|error| error.message);
        merged.map(|(_, libraries)| libraries)
    };
    assert_eq!(merged(&[path("good.fmu"), path("other.fmu")]), Ok(2));

    let zeros = vec![0; 100_000];
    archive(&path("bomb.fmu"), &[description, ("zeros", &zeros)]);
    pretend(&path("bomb.fmu"), u32::MAX - 1);
    archive(&path("more.fmu"), &[description, ("zeros", &zeros)]);
    pretend(&path("more.fmu"), 1000);
    let many: Vec<String> = (0..=limits::FMU_FILES).map(|number| number.to_string()).collect();
    let many: Vec<(&str, &[u8])> = many.iter().map(|name| (name.as_str(), &[][..])).collect();
    archive(&path("many.fmu"), &many);
    archive(&path("out.fmu"), &[description, ("../../evil", b"")]);
    archive(&path("none.fmu"), &[("something", b"")]);
    archive(&path("case.fmu"), &[description, ("resources/case.toml", b"")]);
    archive(
        &path("twice.fmu"),
        &[description, ("binaries/linux64/w.so", b"\x7fELF2")],
    );
    fs::write(path("text.fmu"), "this is no archive").unwrap();
    let large = fs::File::create(path("large.fmu")).unwrap();
    large.set_len(limits::FMU_FILE + 1).unwrap();
    fs::create_dir(path("folder.fmu")).unwrap();
    for (name, what) in [
        (
            "bomb.fmu",
            "unpacked it has more than the 512 MiB that are read, at zeros",
        ),
        ("more.fmu", "larger than its declared uncompressed size"),
        ("many.fmu", "it holds 1001 files, and at most 1000 are read"),
        ("out.fmu", "leads out of its folder"),
        ("none.fmu", "it holds no modelDescription.xml"),
        ("case.fmu", "only FMUs of the same case and version can be merged"),
        (
            "twice.fmu",
            "only FMUs of the same case and version, for different platforms",
        ),
        ("text.fmu", "is no FMU"),
        ("large.fmu", "it has 67108865 bytes, and at most 64 MiB are read"),
        ("folder.fmu", "it is no file"),
        ("missing.fmu", "cannot be read"),
    ] {
        let reason = merged(&[path("good.fmu"), path(name)]).unwrap_err();
        assert!(reason.contains(name) && reason.contains(what), "{name}: {reason}");
        assert!(reason.len() < 600, "{name}: {reason}");
    }
}

#[test]
fn issue_029_what_is_no_library_is_not_put_into_an_fmu() {
    let folder = tempfile::tempdir().unwrap();
    let library = folder.path().join("library");
    let source = Source::Wedge(Box::new(case()));
    let write = |platform: usize| {
        let platform = package::PLATFORMS[platform];
        let read = package::Library::read(&library);
        let written = read.and_then(|read| package::fmu(&source, Version::Two, &read, platform));
        written.map(|_| ()).map_err(|error| error.message)
    };
    let reason = write(0).unwrap_err();
    assert!(
        reason.contains("the library") && reason.contains("cannot be read"),
        "{reason}"
    );
    for (bytes, fits) in [
        (&b"\x7fELF"[..], [0, 1]),
        (b"\xcf\xfa\xed\xfe", [3, 4]),
        (b"MZ", [2, 2]),
        (b"", [9, 9]),
    ] {
        fs::write(&library, bytes).unwrap();
        for platform in 0..package::PLATFORMS.len() {
            let written = write(platform);
            assert_eq!(
                written.is_ok(),
                fits.contains(&platform),
                "{bytes:?} {platform}: {written:?}"
            );
            if let Err(reason) = written {
                assert!(reason.contains("is no library for"), "{reason}");
            }
        }
    }
    let large = fs::OpenOptions::new().write(true).open(&library).unwrap();
    large.set_len(limits::FMU_LIBRARY + 1).unwrap();
    let reason = write(0).unwrap_err();
    assert!(reason.contains("at most 256 MiB are read"), "{reason}");
}
