//! The columns of runs against the rule for names in `docs/conventions.md`: objects, quantities, units and
//! exceptions are read from the tables of that page, so that the page stays true.

use std::collections::BTreeSet;

use mechanics::output::Column;
use quantity::System;
use study::case::builtin;
use study::half_truck::catalog::entry;
use study::half_truck::files::Settings;
use study::half_truck::run::run;
use wedge::outputs::Outputs;

const PAGE: &str = include_str!("../../../../docs/conventions.md");
const ALONG: [&str; 6] = ["x", "y", "z", "longitudinal", "lateral", "vertical"];
const ABOUT: [&str; 3] = ["roll", "pitch", "yaw"];
const BODIES: [&str; 3] = ["wedge", "bolster", "side_frame"];

/// Returns the texts between backticks.
fn quoted(cell: &str) -> Vec<&str> {
    cell.split('`').skip(1).step_by(2).collect()
}

/// Returns the cells of the rows of the table that begins with this header.
fn table(header: &str) -> Vec<Vec<&'static str>> {
    let start = PAGE
        .find(header)
        .unwrap_or_else(|| panic!("no table begins with {header}"));
    PAGE[start..]
        .lines()
        .skip(2)
        .take_while(|line| line.starts_with('|'))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect()
}

/// Returns the names that a pattern stands for, but for its numbers: `{a,b}` is one of them.
fn alternatives(pattern: &str) -> Vec<String> {
    let Some((before, rest)) = pattern.split_once('{') else {
        return vec![pattern.to_owned()];
    };
    let (choices, after) = rest.split_once('}').unwrap();
    let each = choices
        .split(',')
        .map(|choice| format!("{before}{choice}{after}"));
    each.flat_map(|name| alternatives(&name)).collect()
}

fn is_number(part: &str) -> bool {
    !part.is_empty() && part.bytes().all(|byte| byte.is_ascii_digit())
}

/// Returns whether a name is that of a pattern, whose parts N and K are numbers.
fn is_like(name: &str, pattern: &str) -> bool {
    let (parts, wanted): (Vec<&str>, Vec<&str>) = (name.split('_').collect(), pattern.split('_').collect());
    parts.len() == wanted.len()
        && parts.iter().zip(wanted).all(|(part, wanted)| match wanted {
            "N" | "K" => is_number(part),
            _ => *part == wanted,
        })
}

/// Removes one of the words from the end of a name, which may consist of nothing else.
fn strip<'n>(name: &'n str, words: &[&str]) -> Option<(&'n str, usize)> {
    words.iter().enumerate().find_map(|(i, word)| {
        let before = name.strip_suffix(word)?;
        match before {
            "" => Some(("", i)),
            _ => before.strip_suffix('_').map(|before| (before, i)),
        }
    })
}

/// The rule on the page.
struct Rule {
    objects: Vec<&'static str>,
    /// Words of a quantity with units; the longest first.
    quantities: Vec<(&'static str, [&'static str; 2])>,
    exceptions: Vec<String>,
}

impl Rule {
    fn of_page() -> Self {
        let objects = table("| part | meaning |");
        let objects = objects.iter().flat_map(|row| quoted(row[0])).collect();
        let mut quantities = Vec::new();
        for row in table("| quantity | units | sign |") {
            let units = match quoted(row[1])[..] {
                [us, si] => [us, si],
                _ => [""; 2],
            };
            quantities.extend(quoted(row[0]).into_iter().map(|word| (word, units)));
        }
        quantities.sort_by_key(|(word, _)| std::cmp::Reverse(word.len()));
        let exceptions = table("| name | by the rule it would be | reason |");
        let exceptions = exceptions.iter().flat_map(|row| quoted(row[0]));
        Self {
            objects,
            quantities,
            exceptions: exceptions.flat_map(alternatives).collect(),
        }
    }

    /// Returns whether parts joined by `_` are objects, positions and numbers, of which the first is an
    /// object.
    fn is_object(&self, text: &str) -> bool {
        if text.is_empty() {
            return true;
        }
        self.objects.iter().any(|object| match text.strip_prefix(object) {
            Some("") => *object != "N",
            Some(rest) => rest.strip_prefix('_').is_some_and(|rest| self.is_object(rest)),
            None => false,
        }) || text.split_once('_').map_or(is_number(text), |(first, rest)| {
            is_number(first) && self.is_object(rest)
        })
    }

    /// Returns the units (US, SI) of a name without unit; `None` if the name does not follow the rule.
    fn units(&self, name: &str) -> Option<[String; 2]> {
        if name == "time" {
            return Some(["s"; 2].map(str::to_owned));
        }
        let (rest, order) = match strip(name, &["rate", "acceleration"]) {
            Some((rest, i)) => (rest, i + 1),
            None => (name, 0),
        };
        let (along, about) = (strip(rest, &ALONG), strip(rest, &ABOUT));
        let (rest, component) = along.or(about).map_or((rest, false), |(rest, _)| (rest, true));
        let bodies = BODIES.map(|body| format!("on_{body}"));
        let bodies: Vec<&str> = bodies.iter().map(String::as_str).collect();
        let (rest, on_body) = strip(rest, &bodies).map_or((rest, false), |(rest, _)| (rest, true));
        let words: Vec<&str> = self.quantities.iter().map(|(word, _)| *word).collect();
        let (object, units) = match strip(rest, &words) {
            Some((object, i)) => (object, self.quantities[i].1),
            None if component && !on_body && !rest.is_empty() => {
                let units = if about.is_some() { ["rad"; 2] } else { ["in", "m"] };
                (rest, units)
            }
            None => return None,
        };
        // Nothing but a force or moment on a body goes without an object.
        if !self.is_object(object) || (object.is_empty() && !on_body) {
            return None;
        }
        Some(units.map(|unit| match order {
            0 => unit.to_owned(),
            1 => format!("{unit}_per_s"),
            _ => format!("{unit}_per_s2"),
        }))
    }
}

/// Returns the columns of both dampings, and of faces with grids of points.
fn wedge_columns() -> Vec<Column> {
    [
        ("vdrun_toe_out_0.2_psi_0.012", "[2, 2]"),
        ("cdrun_toe_in_0.2_psi_0", "[3, 4]"),
    ]
    .iter()
    .flat_map(|(name, grid)| {
        let case = builtin::case_with(name, &[format!("slope_face.grid={grid}")]).unwrap();
        Outputs::new(&case.parameters).columns().to_vec()
    })
    .collect()
}

/// Returns the columns of half-trucks with all that their data files ask for.
fn truck_columns() -> Vec<Column> {
    let massless =
        ["nucars_68_variable_toe_out", "nucars_69_constant_toe_out"].map(|name| (name, "massless"));
    let bodies = [("nucars_68_variable_toe_out", "bodies")];
    massless
        .into_iter()
        .chain(bodies)
        .flat_map(|(name, wedges)| {
            let settings = Settings {
                all_outputs: true,
                duration: Some(0.02),
                set: vec![format!("option.wedges={wedges}")],
                ..Settings::default()
            };
            let case = entry(name).unwrap().case_with(&settings).unwrap();
            run(&case, |_| ()).unwrap().columns
        })
        .collect()
}

#[test]
fn input_every_column_is_named_by_the_rule_or_a_stated_exception() {
    let rule = Rule::of_page();
    assert!(rule.objects.len() > 20 && rule.quantities.len() > 15 && rule.exceptions.len() > 20);
    let columns: Vec<Column> = wedge_columns().into_iter().chain(truck_columns()).collect();
    let (mut by_rule, mut used) = (BTreeSet::new(), BTreeSet::new());
    for column in &columns {
        let name = &column.name;
        if let Some(pattern) = rule.exceptions.iter().find(|pattern| is_like(name, pattern)) {
            used.insert(pattern.clone());
            continue;
        }
        let Some(units) = rule.units(name) else {
            panic!("`{name}` neither follows the rule of docs/conventions.md nor is one of its exceptions");
        };
        by_rule.insert(name.clone());
        for (system, unit) in [System::Us, System::Si].into_iter().zip(&units) {
            let expected = if unit.is_empty() {
                name.clone()
            } else {
                format!("{name}_{unit}")
            };
            assert_eq!(column.full_name(system), expected, "unit of `{name}`");
        }
    }
    println!("{} names by the rule, exceptions {used:?}", by_rule.len());
    assert!(by_rule.len() > 100);
    for pattern in &rule.exceptions {
        assert!(
            used.contains(pattern),
            "no column is called `{pattern}`: it is no exception"
        );
    }
}

#[test]
fn input_names_that_break_the_rule_are_found() {
    let rule = Rule::of_page();
    for (name, unit) in [
        ("wedge_leading_left_column_normal_force", "lbf"),
        ("side_frame_left_pitch", "rad"),
        ("bolster_vertical_acceleration", "in_per_s2"),
        ("body_3_yaw_rate", "rad_per_s"),
        ("force_on_bolster_x", "lbf"),
        ("coil_load", "lbf"),
    ] {
        assert_eq!(rule.units(name).unwrap()[0], unit, "{name}");
    }
    for name in [
        "vertical_wedge_force",
        "wedge_x_force",
        "wedge",
        "force",
        "x",
        "spin_x",
        "wedge_normal",
        "127_x_y",
    ] {
        assert_eq!(rule.units(name), None, "{name}");
    }
    assert_eq!(alternatives("a_{b,c}_{d,e}").len(), 4);
    assert!(is_like("force_12_3", "force_N_K") && !is_like("force_x_3", "force_N_K"));
}
