//! The half-truck with four wedges that Steets (2007) compares with, as files.
//!
//! Numbers and structure are those of the thesis's appendices A and B, with their inconsistencies, which
//! [`check`](crate::check) reports; titles, comments and free text are our own. The two data files that are
//! both called `sngl_trk.dat` there carry `_68` and `_69` here, while the run files still name
//! `sngl_trk.DAT`.

use std::sync::Arc;

use crate::source::SourceText;

macro_rules! files {
    ($($name:literal),* $(,)?) => {
        [$(($name, include_str!(concat!("../data/", $name)))),*]
    };
}

static FILES: [(&str, &str); 16] = files![
    "Bolst_wedge_sf_68_constant.sys",
    "Bolst_wedge_sf_68_variable.sys",
    "Bolst_wedge_sf_bolst-vert-displ-w-yaw_68_constant.run",
    "Bolst_wedge_sf_bolst-vert-displ-w-yaw_68_variable.run",
    "Bolst_wedge_sf_bolst-vert-displ_68_constant.run",
    "Bolst_wedge_sf_bolst-vert-displ_68_variable.run",
    "bolst_displ_input3.inp",
    "bolst_displ_input36.inp",
    "bolst_wedge_sf_69_const.sys",
    "bolst_wedge_sf_69_var.sys",
    "bolst_wedge_sf_bolst-vert-displ_69_const.run",
    "bolst_wedge_sf_bolst-vert-displ_69_var.run",
    "bolst_wedge_sf_bolst-vrt-displ-w-yaw_69_const.run",
    "bolst_wedge_sf_bolst-vrt-displ-w-yaw_69_var.run",
    "sngl_trk_68.dat",
    "sngl_trk_69.dat",
];

/// Returns the names of the files.
pub fn names() -> impl ExactSizeIterator<Item = &'static str> {
    FILES.iter().map(|(name, _)| *name)
}

/// Returns the text of the file of this name.
pub fn text(name: &str) -> Option<&'static str> {
    FILES
        .iter()
        .find(|(file, _)| *file == name)
        .map(|(_, text)| *text)
}

/// Returns the file of this name, ready to be read.
pub fn source(name: &str) -> Option<Arc<SourceText>> {
    // Only files of 4 GiB are refused.
    SourceText::from_text(name, text(name)?).ok()
}
