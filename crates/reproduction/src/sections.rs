//! The sections of the report: figures that belong together, and the text before them.

use report::figures::{CaseOutcome, Exhibit, capital, run};
use study::case::builtin;
use wedge::parameters::Damping;

use crate::agreement::TruckOutcome;
use crate::figures;
use crate::sensitivity::Sensitivity;

/// Figures that belong together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Section {
    /// Its name in links.
    pub id: String,
    /// Its heading.
    pub title: String,
    /// The features to look at; may be empty.
    pub intro: String,
    /// Its figures.
    pub exhibits: Vec<Exhibit>,
    /// Their drawings as SVG, once they are drawn.
    pub svgs: Vec<String>,
    /// True if it is folded at first.
    pub folded: bool,
    /// The run that it is about, if it is about one.
    pub run: Option<String>,
    /// The heading of folded sections of one kind; may be empty.
    pub group: String,
}

/// Returns the sections of the report on these runs of the thesis's kind.
#[must_use]
pub fn thesis(outcomes: &[CaseOutcome]) -> Vec<Section> {
    let mut plans = vec![Section {
        id: "model".to_owned(),
        title: "Motion, friction law, coil".to_owned(),
        intro: "What goes into the runs.".to_owned(),
        exhibits: figures::model::exhibits(outcomes),
        ..Section::default()
    }];
    for chapter in figures::thesis::chapters(outcomes) {
        let (damping, yawed) = (chapter.damping, chapter.yawed);
        let name = damping.name();
        let with = if yawed {
            "with yaw of the bolster"
        } else {
            "without yaw"
        };
        plans.push(Section {
            id: format!("{name}{}", if yawed { "-yawed" } else { "" }),
            title: format!("{} damping, {with}", capital(name)),
            intro: intro(damping, yawed).to_owned(),
            exhibits: chapter.exhibits,
            ..Section::default()
        });
    }
    plans.extend(outcomes.iter().map(|outcome| Section {
        id: format!("run-{}", outcome.0.name),
        title: format!("{}: {}", outcome.0.name, outcome.0.title),
        exhibits: run::exhibits(outcome),
        folded: true,
        run: Some(outcome.0.name.clone()),
        group: "The thesis's runs".to_owned(),
        ..Section::default()
    }));
    plans.retain(|plan| !plan.exhibits.is_empty());
    plans
}

/// Returns the sections of the cases beyond the thesis, one a group, each with what to look at.
#[must_use]
pub fn beyond(outcomes: &[CaseOutcome]) -> Vec<Section> {
    let group_of = |outcome: &CaseOutcome| builtin::group_of(&outcome.0.name).map(|group| group.name);
    let mut plans = Vec::new();
    for runs in outcomes.chunk_by(|a, b| group_of(a) == group_of(b)) {
        let Some(group) = runs.first().and_then(|(case, _)| builtin::group_of(&case.name)) else {
            continue;
        };
        let Some(figure) = figures::groups::figure(group.name, runs) else {
            continue;
        };
        plans.push(Section {
            id: format!("beyond-{}", group.name.replace('_', "-")),
            title: group.title.to_owned(),
            intro: group.look_at.to_owned(),
            exhibits: vec![Exhibit::new(format!("beyond_{}", group.name), figure)],
            ..Section::default()
        });
    }
    plans
}

/// Returns the sections of runs that are only seen moving: those beyond the thesis, and those of the
/// half-truck.
#[must_use]
pub fn moving(others: &[CaseOutcome], trucks: &[TruckOutcome]) -> Vec<Section> {
    let plan = |name: &str, title: &str, group: &str| Section {
        id: format!("run-{name}"),
        title: format!("{name}: {title}"),
        folded: true,
        run: Some(name.to_owned()),
        group: group.to_owned(),
        ..Section::default()
    };
    let others = others.iter().map(|(case, _)| {
        let group = builtin::group_of(&case.name).map_or("", |group| group.title);
        plan(&case.name, &case.title, group)
    });
    let trucks = trucks.iter().map(|(entry, _)| {
        plan(
            &entry.name(),
            &entry.title(),
            "Half-truck of the comparison program's files",
        )
    });
    others.chain(trucks).collect()
}

/// Returns the section that compares these runs with those of the half-truck; `None` where there are none to
/// be compared.
#[must_use]
pub fn comparison(outcomes: &[CaseOutcome], trucks: &[TruckOutcome]) -> Option<Section> {
    let exhibits = figures::comparison::exhibits(outcomes, trucks);
    (!exhibits.is_empty()).then(|| Section {
        id: "compared".to_owned(),
        title: "Against types 6.8 and 6.9, toe out".to_owned(),
        intro: "The thesis's comparison: its stand-alone wedge against the comparison program's wedges, \
                here our reading of them in the half-truck."
            .to_owned(),
        exhibits,
        ..Section::default()
    })
}

/// Returns the section of the statements over the contact stiffness.
#[must_use]
pub fn sensitivity(found: &Sensitivity) -> Option<Section> {
    let exhibits = figures::sensitivity::exhibits(found);
    (!exhibits.is_empty()).then(|| Section {
        id: "open-stiffness".to_owned(),
        title: "Statements over the contact stiffness".to_owned(),
        exhibits,
        ..Section::default()
    })
}

fn intro(damping: Damping, yawed: bool) -> &'static str {
    match (damping, yawed) {
        (Damping::Variable, false) => {
            "The coil stands on the side frame: it presses the wedge while the bolster is low, and the \
             bolster lifts off when it is high. Then the wedge rings on its coil."
        }
        (Damping::Variable, true) => {
            "The bolster is turned by 0.012 rad, so that the wedge is carried on edges and corners; the \
             ringing of contacts is less, and the pitch and yaw moments are larger."
        }
        (Damping::Constant, false) => {
            "The coil stands in the bolster's pocket: its force hardly changes, and the bolster never lifts \
             off."
        }
        (Damping::Constant, true) => {
            "With the bolster turned by 0.012 rad the corners carry unequal loads, which gives moments \
             about all axes."
        }
    }
}
