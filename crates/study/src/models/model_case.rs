//! What a model answers about its cases, whatever the model.

use mechanics::output::Column;

use super::ModelSummary;
use crate::case::FieldSection;
use crate::losses::EnergySummary;
use crate::measures::{Definitions, Judged, Unmeasured};
use crate::metrics::Cycle;
use crate::output_files::OutputFiles;
use crate::reader::CaseText;
use crate::result::RunResult;
use crate::run::{RunCase, RunError};

/// A case whose runs end with a table and a summary.
pub trait ModelCase: RunCase<Output = RunResult<Self::Summary>> {
    /// The summary of its runs.
    type Summary: ModelSummary;

    /// The part of a summary with the energies of a cycle, or of the run; none of a model without them.
    const ENERGY: Option<fn(&Self::Summary) -> &EnergySummary> = None;

    /// Returns the columns of its runs.
    ///
    /// # Errors
    /// The case makes no system.
    fn columns(&self) -> Result<Vec<Column>, RunError>;

    /// Returns the files of its table, unless others are asked for.
    fn output_files(&self) -> OutputFiles {
        OutputFiles::default()
    }

    /// Returns the text of its case file; `None` of a model without case files.
    fn text(&self) -> Option<&CaseText> {
        None
    }

    /// Returns the completed case file, with the tables that it took from other files inside, so that it runs
    /// anywhere; `None` of a model without case files.
    fn case_file(&self) -> Option<&str> {
        self.text().map(|text| text.embedded.as_str())
    }

    /// Returns its fields as its case file has them; none of a model without case files.
    fn fields(&self) -> &[FieldSection] {
        self.text().map_or(&[], |text| &text.fields)
    }
}

/// A case that studies run and measure.
pub trait StudyCase: ModelCase {
    /// Returns the cycle of its vertical motion, if that is one sine or triangle.
    fn cycle(&self) -> Option<Cycle> {
        None
    }

    /// Returns the measures that a study keeps of its runs.
    fn definitions(&self) -> Definitions;

    /// Runs it, measures it, and judges whether the measures mean something.
    ///
    /// # Errors
    /// The run cannot begin or does not come to its end.
    fn judge(&self) -> Result<Judged, Unmeasured>;
}
