//! Figures as the files of commands: each as a drawing (SVG) and as a picture (PNG).

use drawing::Figure;
use staging::{FileError, Files};

use crate::failure::{Failure, Message};

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
    pub fn of(figure: &Figure) -> Result<Self, Failure> {
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
pub fn png(figure: &Figure) -> Result<Vec<u8>, Failure> {
    let png = figure.to_png();
    png.map_err(|reason| Failure::Failed(Message::new(format!("cannot draw: {reason}"), "").into()))
}
