//! Saved states edited by hand: every member of a saved state, replaced by every value of a list of nasty
//! ones. Other crates use this file too.

use serde_json::{Value, json};

/// Returns the values that replace members.
pub fn nasty_values() -> Vec<Value> {
    vec![
        json!(0),
        json!(-1),
        json!(0.5),
        json!(77),
        json!(1e308),
        json!(-1e308),
        json!(5e-324),
        json!(4_294_967_295_u32),
        json!(1_000_000_000_000_001_u64),
        json!(u64::MAX),
        json!(i64::MIN),
        json!(true),
        Value::Null,
        json!(""),
        json!([]),
        json!({}),
        json!([1.0]),
        json!(vec![0; 1000]),
        nested(100),
    ]
}

fn nested(depth: usize) -> Value {
    (0..depth).fold(json!([]), |inner, _| json!([inner]))
}

/// Returns the places of all members, as JSON pointers; of lists those of some entries.
pub fn members(value: &Value) -> Vec<String> {
    let mut found = Vec::new();
    collect(value, "", &mut found);
    found
}

fn collect(value: &Value, at: &str, found: &mut Vec<String>) {
    let mut member = |name: String, value: &Value| {
        let place = format!("{at}/{name}");
        collect(value, &place, found);
        found.push(place);
    };
    match value {
        Value::Array(list) => {
            let last = list.len().saturating_sub(1);
            let some = [0, 1, last / 2, last];
            let numbers = list.iter().enumerate();
            numbers
                .filter(|(number, _)| some.contains(number))
                .for_each(|(number, value)| member(number.to_string(), value));
        }
        Value::Object(map) => map.iter().for_each(|(name, value)| member(name.clone(), value)),
        _ => {}
    }
}

/// Every state that differs from a saved one in one member, with its place; also with the member left out or,
/// in a list, twice.
pub fn damaged(saved: &Value) -> impl Iterator<Item = (String, Value)> {
    let (values, saved) = (nasty_values(), saved.clone());
    members(&saved).into_iter().flat_map(move |place| {
        let mut all: Vec<(String, Value)> = Vec::with_capacity(values.len() + 1);
        for value in &values {
            let mut edited = saved.clone();
            if let Some(member) = edited.pointer_mut(&place) {
                *member = value.clone();
            }
            let shown: String = value.to_string().chars().take(30).collect();
            all.push((format!("{place} = {shown}"), edited));
        }
        let mut edited = saved.clone();
        if let Some((parent, name)) = place.rsplit_once('/') {
            match edited.pointer_mut(parent) {
                Some(Value::Object(map)) => {
                    map.remove(name);
                    all.push((format!("{place} left out"), edited));
                }
                Some(Value::Array(list)) => {
                    if let Some(last) = list.last().cloned() {
                        list.push(last);
                    }
                    all.push((format!("{place} twice"), edited));
                }
                _ => {}
            }
        }
        all
    })
}
