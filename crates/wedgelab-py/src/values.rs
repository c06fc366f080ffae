//! From Python's values to TOML, and from TOML and JSON to Python's values.

use input::{limits, shortened};
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyMapping, PyString};
use toml::{Table, Value};

use crate::errors::case_message;
use crate::quantity::Quantity;

/// Returns a mapping as TOML. `path` is where it stands, for messages.
pub fn table(mapping: &Bound<'_, PyAny>, path: &str) -> PyResult<Table> {
    nested_table(mapping, path, 0, Nones::Refused)
}

/// What the value `None` means.
#[derive(Clone, Copy, PartialEq)]
enum Nones {
    /// Nothing: it is a mistake.
    Refused,
    /// Attributes of an object that were left out.
    LeftOut,
}

fn nested_table(mapping: &Bound<'_, PyAny>, path: &str, depth: usize, nones: Nones) -> PyResult<Table> {
    let py = mapping.py();
    let Ok(mapping) = mapping.cast::<PyMapping>() else {
        let found = type_name(mapping);
        return Err(case_message(
            py,
            &format!(
                "{} is a {found}; a mapping of keys to values is expected",
                named(path)
            ),
            "pass a dict, or one of the section classes of wedgelab",
        ));
    };
    let mut table = Table::new();
    for item in mapping.items()?.iter() {
        let (key, value): (Bound<'_, PyAny>, Bound<'_, PyAny>) = item.extract()?;
        let Ok(key) = key.extract::<String>() else {
            return Err(case_message(
                py,
                &format!("{} has the key {}, which is no text", named(path), key.repr()?),
                "keys are names, such as \"angle\"",
            ));
        };
        let inner = if path.is_empty() {
            key.clone()
        } else {
            format!("{path}.{key}")
        };
        if value.is_none() && nones == Nones::LeftOut {
            continue;
        }
        table.insert(key, of(&value, &inner, depth + 1)?);
    }
    Ok(table)
}

/// Returns a value as TOML, `depth` values below the outermost: a list may hold itself.
fn of(value: &Bound<'_, PyAny>, path: &str, depth: usize) -> PyResult<Value> {
    if depth > limits::NESTING {
        return Err(case_message(
            value.py(),
            &format!("{} is nested more than {} deep", named(path), limits::NESTING),
            "nothing in a case is nested so deeply; look whether a list or a dict holds itself",
        ));
    }
    if value.is_none() {
        return Err(case_message(
            value.py(),
            &format!("{} is None, which is no value", named(path)),
            "give a value, or leave the key out to keep what the case has",
        ));
    }
    if let Ok(quantity) = value.cast::<Quantity>() {
        return Ok(Value::String(quantity.get().text().to_owned()));
    }
    if let Ok(truth) = value.cast::<PyBool>() {
        return Ok(Value::Boolean(truth.is_true()));
    }
    if let Ok(text) = value.cast::<PyString>() {
        return Ok(Value::String(text.to_string()));
    }
    if value.is_instance_of::<PyInt>() {
        return Ok(match value.extract::<i64>() {
            Ok(number) => Value::Integer(number),
            Err(_) => Value::Float(value.extract::<f64>().unwrap_or(f64::INFINITY)),
        });
    }
    if value.is_instance_of::<PyFloat>() {
        return Ok(Value::Float(value.extract()?));
    }
    if let Ok(to_values) = value.getattr("_to_values") {
        let values = to_values.call0()?;
        if values.cast::<PyMapping>().is_ok() {
            return Ok(Value::Table(nested_table(
                &values,
                path,
                depth + 1,
                Nones::LeftOut,
            )?));
        }
        return of(&values, path, depth + 1);
    }
    if value.cast::<PyMapping>().is_ok() {
        return Ok(Value::Table(nested_table(value, path, depth, Nones::Refused)?));
    }
    // NumPy's arrays and numbers.
    if let Ok(list) = value.getattr("tolist") {
        return of(&list.call0()?, path, depth + 1);
    }
    if let (false, Ok(items)) = (value.hasattr("keys")?, value.try_iter()) {
        let mut list = Vec::new();
        for (at, item) in items.enumerate() {
            // An iterator may never end.
            if at == limits::VALUES {
                return Err(case_message(
                    value.py(),
                    &format!("{} has more than {} values", named(path), limits::VALUES),
                    "look whether the iterator ends; long tables belong into CSV files",
                ));
            }
            list.push(of(&item?, &format!("{path}[{at}]"), depth + 1)?);
        }
        return Ok(Value::Array(list));
    }
    Err(case_message(
        value.py(),
        &format!(
            "{} is a {}, which no case can hold",
            named(path),
            type_name(value)
        ),
        "write a text with a unit (\"32 deg\"), a number in SI units, a Quantity, a list, or a dict",
    ))
}

fn named(path: &str) -> String {
    if path.is_empty() {
        "the case".to_owned()
    } else {
        format!("`{}`", shortened(path))
    }
}

fn type_name(value: &Bound<'_, PyAny>) -> String {
    value
        .get_type()
        .name()
        .map_or_else(|_| "?".to_owned(), |name| name.to_string())
}

/// TOML as Python's values.
pub fn from_toml<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Integer(number) => number.into_pyobject(py)?.into_any(),
        Value::Float(number) => number.into_pyobject(py)?.into_any(),
        Value::Boolean(truth) => truth.into_pyobject(py)?.to_owned().into_any(),
        Value::Datetime(date) => date.to_string().into_pyobject(py)?.into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|item| from_toml(py, item));
            PyList::new(py, items.collect::<PyResult<Vec<_>>>()?)?.into_any()
        }
        Value::Table(table) => {
            let dict = PyDict::new(py);
            for (key, value) in table {
                dict.set_item(key, from_toml(py, value)?)?;
            }
            dict.into_any()
        }
    })
}

/// JSON as Python's values.
pub fn from_json<'py>(py: Python<'py>, value: &serde_json::Value) -> PyResult<Bound<'py, PyAny>> {
    use serde_json::Value;
    Ok(match value {
        Value::Null => py.None().into_bound(py),
        Value::Bool(truth) => truth.into_pyobject(py)?.to_owned().into_any(),
        Value::Number(number) => match (number.as_i64(), number.as_u64(), number.as_f64()) {
            (Some(whole), ..) => whole.into_pyobject(py)?.into_any(),
            (_, Some(whole), _) => whole.into_pyobject(py)?.into_any(),
            (.., number) => number.unwrap_or(f64::NAN).into_pyobject(py)?.into_any(),
        },
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Array(items) => {
            let items = items.iter().map(|item| from_json(py, item));
            PyList::new(py, items.collect::<PyResult<Vec<_>>>()?)?.into_any()
        }
        Value::Object(entries) => {
            let dict = PyDict::new(py);
            for (key, value) in entries {
                dict.set_item(key, from_json(py, value)?)?;
            }
            dict.into_any()
        }
    })
}
