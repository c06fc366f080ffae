//! The page of a car's stability: motions by name, in 3D, with what they need.

use std::ops::ControlFlow;

use quantity::System as Units;
use report::page::stability::write;
use report::view::kept::data_in;
use serde_json::Value;
use study::car::builtin;
use study::car::mode_shape::motions;
use study::car::stability::stability;

/// Each motion has its fold with its name and a run in the data, whose scene has every column that it names,
/// no forces, and places in steady running that are not exaggerated. The verdict and all speeds are there.
#[test]
fn input_the_page_names_motions_and_holds_what_they_need() {
    let case = builtin::case_with("car_hunting_roller_empty", &[]).unwrap();
    let speeds = [60.0, 80.0].map(|mph| mph * 0.447_04);
    let found = stability(&case, &speeds, |_| ControlFlow::Continue(())).unwrap();
    let shown = motions(&found);
    // Two of the curve, one without friction.
    assert_eq!(shown.len(), 3);
    let mut page = Vec::new();
    write(&case, &found, Units::Us, &mut page).unwrap();
    let page = String::from_utf8(page).unwrap();
    assert!(page.contains(&found.verdict(Units::Us)));
    for own in found.curve.iter().filter_map(|own| own.critical.as_ref()) {
        assert!(page.contains(&format!("{:.1} mph", own.speed / 0.447_04)) && page.contains(&own.name));
    }
    let data: Value = serde_json::from_str(&data_in(&page).unwrap()).unwrap();
    let runs = data["runs"].as_array().unwrap();
    assert_eq!(runs.len(), shown.len());
    for (number, run) in (1..).zip(runs) {
        let name = format!("motion {number}");
        assert_eq!(run["name"], name);
        assert!(page.contains(&format!("data-run=\"{name}\"")));
        let scene = &run["scene"];
        assert!(scene["contacts"].as_array().unwrap().is_empty() && scene.get("patches").is_none());
        let columns = run["columns"].as_object().unwrap();
        for body in scene["bodies"].as_array().unwrap() {
            for what in ["coordinates", "steady"] {
                let names = body[what].as_array().unwrap().iter().filter_map(Value::as_str);
                for name in names {
                    assert!(columns.contains_key(name), "{name}");
                    let constant = columns[name].get("value").is_some();
                    assert!(what == "coordinates" || constant, "{name} moves");
                }
            }
        }
        assert!(
            columns
                .keys()
                .all(|name| !name.contains("force") && !name.contains("normal"))
        );
        assert!(scene["factor"].as_f64().unwrap() > 1.0, "{}", scene["factor"]);
    }
}
