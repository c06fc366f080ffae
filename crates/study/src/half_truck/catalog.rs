//! The runs of the thesis's table 4-1 with the comparison program's half-truck: two types of wedge, two
//! dampings, three toes, without and with yaw.
//!
//! Eight of them have printed files (toe out); the others are made from these by their toe: type 6.8 by its
//! flag, type 6.9 by the face of the column (none: flat; in: the printed one inverted). A zero toe takes the
//! toe-out branch, so that type 6.8, which has no angle, gives the same forces for no toe and for toe out.

use nucars::builtin;
use nucars::read::{read_data, read_input, read_system};
use nucars::tree::{DataFile, InputFile, Law, SystemFile, Toe};
use nucars::truck::{Choices, Yaw};
use wedge::parameters::Damping;

use super::HalfTruckCase;
use super::files::{self, FileTrees, FilesError, Settings};

/// The type of the wedges.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum WedgeType {
    /// 6.8: vertical and lateral.
    Plain,
    /// 6.9: vertical, longitudinal and lateral.
    Spatial,
}

impl WedgeType {
    /// Returns the code as in the files.
    #[must_use]
    pub fn code(self) -> &'static str {
        match self {
            Self::Plain => "6.8",
            Self::Spatial => "6.9",
        }
    }
}

/// The direction of the toe.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum ToeCase {
    /// Toe out, as printed.
    Out,
    /// No toe.
    None,
    /// Toe in.
    In,
}

impl ToeCase {
    /// In names.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Out => "out",
            Self::None => "none",
            Self::In => "in",
        }
    }
}

/// The yaw of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum YawCase {
    /// Not yawed.
    Straight,
    /// Yawed as the files mean it.
    Intended,
    /// With the yawed input as the files print it, which hardly yaws.
    Printed,
}

/// A run of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CatalogEntry {
    /// The type of the wedges.
    pub wedges: WedgeType,
    /// Their damping.
    pub damping: Damping,
    /// Their toe.
    pub toe: ToeCase,
    /// The yaw.
    pub yaw: YawCase,
}

/// Returns all runs: the 24 of the table, and the four yawed ones as printed.
#[must_use]
pub fn entries() -> Vec<CatalogEntry> {
    let mut entries = Vec::new();
    for wedges in [WedgeType::Plain, WedgeType::Spatial] {
        for damping in [Damping::Variable, Damping::Constant] {
            for yaw in [YawCase::Straight, YawCase::Intended, YawCase::Printed] {
                for toe in [ToeCase::Out, ToeCase::None, ToeCase::In] {
                    if yaw != YawCase::Printed || toe == ToeCase::Out {
                        entries.push(CatalogEntry {
                            wedges,
                            damping,
                            toe,
                            yaw,
                        });
                    }
                }
            }
        }
    }
    entries
}

impl CatalogEntry {
    /// Returns its name, such as `nucars_69_constant_toe_out_yaw`.
    #[must_use]
    pub fn name(&self) -> String {
        let yaw = match self.yaw {
            YawCase::Straight => "",
            YawCase::Intended => "_yaw",
            YawCase::Printed => "_yaw_as_printed",
        };
        format!(
            "nucars_{}_{}_toe_{}{yaw}",
            self.wedges.code().replace('.', ""),
            self.damping.name(),
            self.toe.name()
        )
    }

    /// Returns the title, one line.
    #[must_use]
    pub fn title(&self) -> String {
        let yaw = match self.yaw {
            YawCase::Straight => "not yawed",
            YawCase::Intended => "yawed as intended",
            YawCase::Printed => "yaw input as printed, which hardly yaws",
        };
        let toe = match self.toe {
            ToeCase::Out => "toe out",
            ToeCase::None => "no toe",
            ToeCase::In => "toe in",
        };
        format!(
            "half-truck with wedges of type {}, {} damping, {toe}, {yaw}",
            self.wedges.code(),
            self.damping.name()
        )
    }

    /// Returns whether its files are printed in the thesis.
    #[must_use]
    pub fn is_printed(&self) -> bool {
        self.toe == ToeCase::Out && self.yaw != YawCase::Intended
    }

    /// Returns the names of its built-in files: system, input, data.
    #[must_use]
    pub fn files(&self) -> [&'static str; 3] {
        let system = match (self.wedges, self.damping) {
            (WedgeType::Plain, Damping::Variable) => "Bolst_wedge_sf_68_variable.sys",
            (WedgeType::Plain, Damping::Constant) => "Bolst_wedge_sf_68_constant.sys",
            (WedgeType::Spatial, Damping::Variable) => "bolst_wedge_sf_69_var.sys",
            (WedgeType::Spatial, Damping::Constant) => "bolst_wedge_sf_69_const.sys",
        };
        let input = match self.yaw {
            YawCase::Straight => "bolst_displ_input3.inp",
            _ => "bolst_displ_input36.inp",
        };
        let data = match self.wedges {
            WedgeType::Plain => "sngl_trk_68.dat",
            WedgeType::Spatial => "sngl_trk_69.dat",
        };
        [system, input, data]
    }

    /// Returns the run, of `duration` seconds with a row each 0.01 s.
    ///
    /// `choices.yaw` says how the intended yaw is reached; as printed stands for the default way.
    ///
    /// # Errors
    /// None happen with the built-in files, which the tests read.
    pub fn case(&self, choices: &Choices, duration: f64) -> Result<HalfTruckCase, FilesError> {
        self.case_with(&Settings {
            choices: choices.clone(),
            duration: Some(duration),
            ..Settings::default()
        })
    }

    /// Returns the run with other settings; without a duration, the files' 20 s.
    ///
    /// # Errors
    /// A value of the settings is wrong; the built-in files have no mistakes.
    pub fn case_with(&self, settings: &Settings) -> Result<HalfTruckCase, FilesError> {
        let [system, input, data] = self.files();
        let mut system = tree_of::<SystemFile>(system)?;
        let input = tree_of::<InputFile>(input)?;
        let data = tree_of::<DataFile>(data)?;
        set_toe(&mut system, self.toe);
        let mut settings = settings.clone();
        settings.duration = Some(settings.duration.unwrap_or(DURATION));
        settings.choices.yaw = match (self.yaw, settings.choices.yaw) {
            (YawCase::Intended, Yaw::AsPrinted) => Yaw::Dropped,
            (YawCase::Intended, own) => own,
            _ => Yaw::AsPrinted,
        };
        let files = FileTrees {
            system: &system,
            input: Some(&input),
            data: Some(&data),
            run: None,
        };
        let mut case = files::case(&self.name(), &self.title(), files, &settings)?;
        case.script_interval = OUTPUT_INTERVAL;
        if !self.is_printed() {
            case.assumptions
                .push("made from the printed files of the same type and damping by toe and yaw".to_owned());
        }
        Ok(case)
    }
}

/// The end of the printed runs, s.
pub const DURATION: f64 = 20.0;
/// The interval of the printed runs' results, s.
pub const OUTPUT_INTERVAL: f64 = 0.1;

/// Returns the run of this name.
#[must_use]
pub fn entry(name: &str) -> Option<CatalogEntry> {
    entries().into_iter().find(|entry| entry.name() == name)
}

/// Trees that are read from built-in files.
trait Tree: Sized {
    fn read(name: &str) -> Option<Self>;
}

macro_rules! tree {
    ($tree:ty, $read:ident) => {
        impl Tree for $tree {
            fn read(name: &str) -> Option<Self> {
                $read(&builtin::source(name)?).strict().ok()
            }
        }
    };
}

tree!(SystemFile, read_system);
tree!(InputFile, read_input);
tree!(DataFile, read_data);

fn tree_of<T: Tree>(name: &str) -> Result<T, FilesError> {
    T::read(name).ok_or(FilesError::NoSystem)
}

/// Gives all wedges of a system with toe out another toe.
fn set_toe(system: &mut SystemFile, toe: ToeCase) {
    let factor = match toe {
        ToeCase::Out => return,
        ToeCase::None => 0.0,
        ToeCase::In => -1.0,
    };
    let mut faces = Vec::new();
    for characteristic in &mut system.characteristics {
        match &mut characteristic.law {
            Law::StickSlipWedge { toe: flag, .. } | Law::ViscousToeWedge { toe: flag, .. } => {
                flag.value = match toe {
                    ToeCase::In => Toe::In,
                    _ => Toe::Out,
                };
            }
            Law::StickSlipWedge3d { face, .. } => faces.push(face.value),
            _ => {}
        }
    }
    for function in &mut system.piecewise_linear {
        if faces.contains(&*function.id) {
            for ordinate in &mut function.ordinates {
                ordinate.value *= factor;
            }
        }
    }
}
