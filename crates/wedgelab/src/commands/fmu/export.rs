//! `wedgelab fmu export`: the wedge, truck or car of a case, or the half-truck of a run, as an FMU.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use fmi::description::Version;
use fmi::package::{self, Library, Platform};
use fmi::source::Source;
use study::car::CarCase;
use study::models::AnyCase;
use study::truck::TruckCase;
use study::vehicle::VehicleCase;

use super::half_truck::Choice;
use super::write;
use crate::commands::run;
use crate::failure::{Failure, Message};

/// Write the wedge, truck, car or vehicle of a case, or the half-truck of a run, as an FMU
///
/// The file holds the model for model exchange and for co-simulation, the case or the files of the run, a
/// page that documents all variables, and the library for the platform that this program runs on. It needs
/// nothing else.
#[derive(Debug, Args)]
#[command(after_long_help = "\
Examples:
  wedgelab fmu export my.toml -o wedge.fmu
  wedgelab fmu export cdrun_toe_0_psi_0 -o wedge.fmu --fmi 3
  wedgelab fmu export my.toml -o simple.fmu --quasi-static
  wedgelab fmu export truck_warp_nest_variable_rising -o truck.fmu
  wedgelab fmu export car_pitch_and_bounce_loaded -o car.fmu
  wedgelab fmu export half_truck.run -o half.fmu
  wedgelab fmu export nucars_69_constant_toe_out -o half.fmu")]
pub struct Arguments {
    /// Case file, or run file of a half-truck (.RUN), or, if there is no such file, the name of a built-in
    /// case or run
    case: PathBuf,
    /// File to write
    #[arg(long, short, value_name = "FILE")]
    out: PathBuf,
    /// Version of the standard
    #[arg(long, value_name = "VERSION", default_value = "2", value_parser = version)]
    fmi: Version,
    /// The quasi-static wedge: without mass, contact stiffness and moments
    #[arg(long)]
    quasi_static: bool,
    /// The truck without its wedges: half a car on a bolster, side frames, springs; with room for four wedges
    /// of the case
    #[arg(long, conflicts_with = "quasi_static")]
    truck: bool,
    /// Set one value over those of the case; VALUE is TOML (quotes around text may be left out)
    #[arg(long, value_name = "PATH.KEY=VALUE")]
    set: Vec<String>,
    #[command(flatten)]
    choice: Choice,
    /// The library for the FMU [default: the one that this program carries]
    #[arg(long, value_name = "FILE")]
    library: Option<PathBuf>,
    /// Overwrite an existing file
    #[arg(long)]
    force: bool,
}

/// Reads a version of the standard.
pub(crate) fn version(text: &str) -> Result<Version, String> {
    match text {
        "2" | "2.0" => Ok(Version::Two),
        "3" | "3.0" => Ok(Version::Three),
        _ => Err("write 2 or 3".to_owned()),
    }
}

/// Executes the command.
pub fn execute(arguments: &Arguments) -> Result<ExitCode, Failure> {
    let source = arguments.source()?;
    may_write(&arguments.out, arguments.force)?;
    let (platform, library) = parts(arguments.library.as_deref())?;
    let (bytes, description) = package::fmu(&source, arguments.fmi, &library, platform)
        .map_err(|error| Failure::from(Message::new(error.to_string(), "nothing was written")))?;
    write(&arguments.out, arguments.force, &bytes)?;
    writeln!(
        io::stdout().lock(),
        "Written {}: {} of the {} {}, FMI {}, model exchange and co-simulation, {} variables, \
         {} states, for {}.",
        arguments.out.display(),
        description.model.name(),
        description.model.origin(),
        description.case,
        match arguments.fmi {
            Version::Two => "2.0",
            Version::Three => "3.0",
        },
        description.variables.len(),
        description.entries.states.len(),
        platform.folder(arguments.fmi),
    )?;
    Ok(ExitCode::SUCCESS)
}

impl Arguments {
    /// Returns the source of the FMU.
    fn source(&self) -> Result<Source, Failure> {
        if let Some(half_truck) = self.choice.half_truck(&self.case, &self.set)? {
            let option = match (self.quasi_static, self.truck) {
                (true, _) => "--quasi-static",
                (_, true) => "--truck",
                _ => return Ok(Source::HalfTruck(Box::new(half_truck))),
            };
            let message = format!(
                "{} is a half-truck, and {option} is for wedges",
                self.case.display()
            );
            return Err(Message::new(message, "leave it out, or name the case of a wedge").into());
        }
        let any = run::read_any(&self.case, &self.set)?;
        let whole = match &any {
            AnyCase::Truck(case) => Some(Source::ThreePieceTruck(Box::new(TruckCase::clone(case)))),
            AnyCase::Car(case) => Some(Source::Car(Box::new(CarCase::clone(case)))),
            AnyCase::Vehicle(case) => Some(Source::Vehicle(Box::new(VehicleCase::clone(case)))),
            _ => None,
        };
        if let Some(source) = whole {
            let what = any.model();
            let option = match (self.quasi_static, self.truck) {
                (true, _) => Some("--quasi-static".to_owned()),
                (_, true) => Some("--truck".to_owned()),
                _ => self.choice.given(),
            };
            return match option {
                None => Ok(source),
                Some(option) => {
                    let message = format!(
                        "{} is a {what}, and {option} is not for {what}s",
                        self.case.display()
                    );
                    Err(Message::new(message, "leave it out").into())
                }
            };
        }
        let case = Box::new(run::wedge_of(any)?);
        if let Some(option) = self.choice.given() {
            let message = format!(
                "{} is a case, and {option} is for half-trucks",
                self.case.display()
            );
            return Err(Message::new(message, "leave it out, or name a run file").into());
        }
        Ok(match (self.quasi_static, self.truck) {
            (true, _) => Source::QuasiStatic(case),
            (_, true) => Source::Truck(case),
            _ => Source::Wedge(case),
        })
    }
}

/// The library that this program carries: empty if it was not compiled together with it.
static LIBRARY: &[u8] = include_bytes!(env!("WEDGELAB_FMU_LIBRARY"));

const BUILD: &str = "`cargo build --release -p wedgelab-fmu` makes it, in the folder target/release; \
                     `--library FILE` names it";

/// Returns the platform of this program, and the library for it: the one that is named, or the one that it
/// carries.
pub(super) fn parts(library: Option<&Path>) -> Result<(Platform, Library), Failure> {
    let Some(platform) = Platform::here() else {
        let message = format!(
            "FMUs know no platform {}-{}",
            std::env::consts::ARCH,
            std::env::consts::OS
        );
        return Err(Message::new(message, "export on Linux, Windows or macOS").into());
    };
    let library = match library {
        Some(library) if library.is_file() => {
            Library::read(library).map_err(|error| Message::new(error.to_string(), BUILD))?
        }
        Some(library) => {
            let message = format!("there is no library {}", library.display());
            return Err(Message::new(message, BUILD).into());
        }
        None if LIBRARY.is_empty() => {
            return Err(Message::new("this program does not carry the library of FMUs", BUILD).into());
        }
        None => Library::carried(LIBRARY),
    };
    Ok((platform, library))
}

/// Checks whether a file may be written.
pub(super) fn may_write(path: &Path, force: bool) -> Result<(), Failure> {
    if path.is_dir() {
        let message = format!("{} is a folder", path.display());
        return Err(Message::new(message, "name a file, such as wedge.fmu").into());
    }
    if path.exists() && !force {
        let message = format!("{} exists", path.display());
        return Err(Message::new(message, "`--force` overwrites it; or write another name after -o").into());
    }
    Ok(())
}
