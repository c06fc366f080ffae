//! Quantities with units.

use ::quantity::{Kind, Quantity as Inner, Unit};
use pyo3::basic::CompareOp;
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyString, PyTuple};

use crate::errors::{simple, unit_error};

/// A number with its unit.
#[pyclass(frozen, module = "wedgelab._wedgelab", name = "Quantity")]
pub struct Quantity {
    inner: Inner,
}

impl Quantity {
    /// Returns the text as typed.
    pub fn text(&self) -> &str {
        self.inner.text()
    }
}

fn parse(py: Python<'_>, text: &str) -> PyResult<Inner> {
    Inner::parse(text).map_err(|error| unit_error(py, text, &error))
}

#[pymethods]
impl Quantity {
    #[new]
    #[pyo3(signature = (value, unit=None))]
    fn new(value: &Bound<'_, PyAny>, unit: Option<&str>) -> PyResult<Self> {
        let py = value.py();
        if let Ok(other) = value.cast::<Self>() {
            let inner = other.get().inner.clone();
            return Ok(Self { inner });
        }
        if let (Ok(text), None) = (value.cast::<PyString>(), unit) {
            return Ok(Self {
                inner: parse(py, &text.to_string())?,
            });
        }
        let Ok(number) = value.extract::<f64>() else {
            let message = "a text such as \"32 deg\" is expected, or a number and a unit";
            return Err(PyTypeError::new_err(message));
        };
        let text = format!("{number} {}", unit.unwrap_or(""));
        let inner = Inner::new(number, unit.unwrap_or("")).map_err(|error| unit_error(py, &text, &error))?;
        Ok(Self { inner })
    }

    #[getter]
    fn value(&self) -> f64 {
        self.inner.value()
    }

    #[getter]
    fn unit(&self) -> &str {
        self.inner.unit_text()
    }

    #[getter]
    fn si(&self) -> f64 {
        self.inner.to_si()
    }

    fn to(&self, py: Python<'_>, unit: &str) -> PyResult<f64> {
        let other = Inner::new(1.0, unit).map_err(|error| unit_error(py, &format!("1 {unit}"), &error))?;
        let target: Unit = other.unit();
        if target.dimension() != self.inner.dimension() {
            let message = format!("{} cannot be expressed in {}", self.inner, unit.trim());
            return Err(simple(py, "UnitError", &message, "name a unit of the same kind"));
        }
        Ok(self.inner.to_si() / target.factor())
    }

    fn __float__(&self) -> f64 {
        self.inner.to_si()
    }

    fn __str__(&self) -> &str {
        self.inner.text()
    }

    fn __repr__(&self) -> String {
        format!("Quantity('{}')", self.inner.text())
    }

    fn __richcmp__(&self, other: &Bound<'_, PyAny>, how: CompareOp) -> PyResult<Py<PyAny>> {
        let py = other.py();
        let Ok(other) = other.cast::<Self>() else {
            return Ok(py.NotImplemented());
        };
        let other = &other.get().inner;
        let alike = self.inner.dimension() == other.dimension();
        let order = self.inner.to_si().partial_cmp(&other.to_si());
        let holds = match how {
            CompareOp::Eq => alike && order.is_some_and(|order| order.is_eq()),
            CompareOp::Ne => !(alike && order.is_some_and(|order| order.is_eq())),
            _ if !alike => return Ok(py.NotImplemented()),
            how => order.is_some_and(|order| how.matches(order)),
        };
        Ok(holds.into_pyobject(py)?.to_owned().into_any().unbind())
    }

    fn __hash__(&self) -> u64 {
        // Equal numbers have equal bits, but for the two zeros.
        (self.inner.to_si() + 0.0).to_bits()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let text = PyTuple::new(slf.py(), [slf.get().inner.text()])?;
        Ok((slf.get_type().into_any(), text))
    }
}

/// Returns the kind of this name, as in `mass`, `angular_speed`.
fn kind(name: &str) -> Option<Kind> {
    let quoted = serde_json::Value::String(name.to_owned());
    serde_json::from_value(quoted).ok()
}

/// Returns a text, a quantity or a number (SI) that stands for this kind, in SI.
#[pyfunction]
pub fn to_si(value: &Bound<'_, PyAny>, kind_name: &str) -> PyResult<f64> {
    let py = value.py();
    let Some(kind) = kind(kind_name) else {
        return Err(PyTypeError::new_err(format!("there is no kind `{kind_name}`")));
    };
    let inner = match value.cast::<Quantity>() {
        Ok(quantity) => quantity.get().inner.clone(),
        Err(_) => match value.cast::<PyString>() {
            Ok(text) => parse(py, &text.to_string())?,
            Err(_) => {
                return value.extract::<f64>().map_err(|_| {
                    let message = format!(
                        "{} is expected: a text with a unit, or a number in SI units",
                        kind.name()
                    );
                    PyTypeError::new_err(message)
                });
            }
        },
    };
    inner
        .check(kind)
        .map_err(|error| unit_error(py, inner.text(), &error))?;
    Ok(inner.to_si())
}
