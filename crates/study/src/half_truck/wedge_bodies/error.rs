//! Reasons why a wedge of the files makes no body.

use quantity::Number;
use thiserror::Error;

use super::words::rounded;

/// Reasons why a wedge of the files makes no body.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum WedgeBodyError {
    /// No wedge is of type 6.8 or 6.9.
    #[error(
        "wedge bodies were asked for, but the files have no wedge of type 6.8 or 6.9: leave them massless \
         (wedges=massless)"
    )]
    NoWedge,
    /// The column is no plane.
    #[error(
        "the column of connection {connection} has {count} inclinations, from {} to {} deg (toe out \
         positive), and a wedge body slides on a plane: give its profile (PWL-toe of its characteristic) \
         one slope, or leave the wedges massless (wedges=massless)",
        Number(*from),
        Number(*to)
    )]
    NotPlane {
        /// The connection's number.
        connection: u32,
        /// Number of inclinations.
        count: usize,
        /// The least, degrees, out positive.
        from: f64,
        /// The greatest.
        to: f64,
    },
    /// The column's side is not said.
    #[error(
        "connection {connection} is a wedge of type 6.8, which does not say on which side its column lies, \
         and no other wedge ahead of it or behind it on body {body} tells: use type 6.9 with XDIR, or leave \
         the wedges massless (wedges=massless)"
    )]
    NoDirection {
        /// The connection's number.
        connection: u32,
        /// The number of the body with the column.
        body: u32,
    },
    /// No force presses the wedge.
    #[error(
        "the coil of connection {connection} has neither a force nor a function that pushes within 1 in of \
         compression, so that nothing presses a wedge body against its faces: give it one, or leave the \
         wedges massless (wedges=massless)"
    )]
    NoCoil {
        /// The connection's number.
        connection: u32,
    },
    /// A value that no body can have.
    #[error("{what} of connection {connection} is {}; for a wedge body it must \
             {must}", Number(rounded(*value)))]
    Value {
        /// The connection's number.
        connection: u32,
        /// The name of the value.
        what: &'static str,
        /// The value.
        value: f64,
        /// The rule.
        must: &'static str,
    },
}
