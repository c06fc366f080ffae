//! The power flow figure: where the energy of a cycle comes from and where it goes.

use ::study::losses::flow::{Flow, PowerFlow};
use ::study::losses::{EnergySummary, STATES};

use super::digits;
use drawing::Colour;
use drawing::Figure;
use drawing::flow::{Band, FlowChart, FlowNode};

/// Names and colors of the contact states.
const NAMED: [(&str, Colour); STATES.len()] = [
    ("in open contacts", Colour::Sky),
    ("while sticking", Colour::Black),
    ("while slipping", Colour::Orange),
];
/// A flow smaller than this share of the inflow is not drawn: it would be thinner than a line.
const THIN: f64 = 1e-3;

/// Returns the figure of a run; `None` if it has no energies.
#[must_use]
pub fn figure(energy: &EnergySummary) -> Option<Figure> {
    let flow = PowerFlow::of(energy)?;
    let unit = flow.unit.as_str();
    let whole = flow.inflow();
    let over = match &energy.distance {
        None => format!("Mean of {} whole cycles", energy.cycles),
        Some(distance) => format!("The whole run of {} {}", digits(distance.value), distance.unit),
    };
    Some(Figure {
        title: format!("Energy of a {}: {} {unit}", energy.whole(), digits(whole)),
        caption: format!(
            "{over}, from {} s to {} s. From left to right: what is put in (work of \
             prescribed motions and loads; stored energy that is given back), what flows through, where it \
             goes, and in which state the contacts were where friction took it. Widths are proportional to \
             energies. In: {} {unit}; out: {} {unit}; the difference of {:.1e} {unit} is the residual of the \
             energy ledger.",
            digits(energy.window[0]),
            digits(energy.window[1]),
            digits(whole),
            digits(flow.outflow()),
            flow.residual,
        ),
        flow: Some(chart(&flow)),
        ..Figure::default()
    })
}

/// Returns the chart: sources, all that flows, losses, contact states.
fn chart(flow: &PowerFlow) -> FlowChart {
    let (whole, unit) = (flow.inflow(), flow.unit.as_str());
    let label = |name: &str, value: f64| {
        let share = 100.0 * value / whole;
        format!("{name}\n{} {unit}, {share:.1} %", digits(value))
    };
    let drawn = |flows: &[Flow]| -> Vec<Flow> {
        let large = flows.iter().filter(|flow| flow.energy >= THIN * whole);
        large.cloned().collect()
    };
    let mut chart = FlowChart::default();
    let mut node = |column, name: &str, value: f64, colour| {
        chart.nodes.push(FlowNode {
            column,
            label: if name.is_empty() {
                String::new()
            } else {
                label(name, value)
            },
            value,
            colour,
        });
        chart.nodes.len() - 1
    };
    let mut bands = Vec::new();
    let through = node(1, "", whole, Colour::Grey);
    for source in drawn(&flow.inflows) {
        let from = node(0, &source.name, source.energy, Colour::Blue);
        bands.push((from, through, source.energy));
    }
    let sinks = drawn(&flow.outflows);
    let mut places = Vec::new();
    for (number, sink) in sinks.iter().enumerate() {
        let colours = [Colour::Vermillion, Colour::Green, Colour::Purple];
        let to = node(2, &sink.name, sink.energy, colours[number % colours.len()]);
        bands.push((through, to, sink.energy));
        places.push(to);
    }
    for (state, (name, colour)) in NAMED.into_iter().enumerate().rev() {
        let all: f64 = sinks.iter().map(|sink| sink.by_state[state]).sum();
        if all < THIN * whole {
            continue;
        }
        let to = node(3, name, all, colour);
        for (sink, from) in sinks.iter().zip(&places) {
            if sink.by_state[state] > 0.0 {
                bands.push((*from, to, sink.by_state[state]));
            }
        }
    }
    chart.bands = bands
        .into_iter()
        .map(|(from, to, value)| Band { from, to, value })
        .collect();
    chart
}
