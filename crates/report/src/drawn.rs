//! Figures as files: each as a drawing (SVG) and as a picture (PNG).

use std::io;
use std::path::PathBuf;

use drawing::Figure;
use miette::Diagnostic;
use staging::{FileError, Files};
use thiserror::Error;

/// A figure cannot be drawn as a picture.
#[derive(Debug, Error, Diagnostic)]
#[error("cannot draw: {0}")]
pub struct DrawError(String);

impl From<DrawError> for FileError {
    fn from(error: DrawError) -> Self {
        Self::Write {
            file: PathBuf::from("figure"),
            reason: io::Error::other(error.0),
        }
    }
}

/// A figure that is drawn, so that nothing can go wrong when files are written.
pub struct Drawn {
    svg: String,
    png: Vec<u8>,
}

impl Drawn {
    /// Draws a figure.
    ///
    /// # Errors
    /// It cannot be drawn as a picture.
    pub fn of(figure: &Figure) -> Result<Self, DrawError> {
        Ok(Self {
            svg: figure.to_svg(),
            png: png(figure)?,
        })
    }

    /// Adds both to the files of a folder.
    ///
    /// # Errors
    /// A file cannot be written.
    pub fn add(&self, files: &mut Files<'_>, drawing: &str, picture: &str) -> Result<(), FileError> {
        files.add(drawing, |out| out.write_all(self.svg.as_bytes()))?;
        files.add(picture, |out| out.write_all(&self.png))
    }
}

/// Draws a figure as a picture.
///
/// # Errors
/// It cannot be drawn.
pub fn png(figure: &Figure) -> Result<Vec<u8>, DrawError> {
    figure.to_png().map_err(DrawError)
}
