//! The linear model of a system about a state: its matrices, and its sliders apart from them.

use integrate::Problem;
use nalgebra::DMatrix;

use super::System;
use crate::connection::{FrictionRule, FrictionRules, Law};
use crate::friction::FrictionLaw;
use crate::linear::{Entry, LinearModel, SecondOrder, Slider, SliderPlace, SlidingPair};

impl System {
    /// Returns the linear model about a state at rest or in steady motion, in which nothing slips. Bristles
    /// are taken relaxed, whatever their deflections in the state: so every closed point sticks; the turning
    /// of their forces with the bodies is left out.
    ///
    /// Coordinates are the positions in the order of the state vector.
    #[must_use]
    pub fn linear_model(&mut self, time: f64, x: &[f64]) -> LinearModel {
        let layout = self.layout;
        let n = layout.speeds;
        let mut state = x.to_vec();
        let kept = self.pairs_of_elements();
        let relaxed = (0..layout.internals).filter(|i| !kept.contains(&(i / 2)));
        relaxed.for_each(|i| state[2 * n + i] = 0.0);
        let rules = FrictionRules {
            surfaces: FrictionRule::Stuck,
            wedges: FrictionRule::Stuck,
        };
        let before = std::mem::replace(&mut self.connections.friction_rules, rules);
        let mut dx = vec![0.0; state.len()];
        let mut df_dt = vec![0.0; state.len()];
        self.derivative(time, &state, &mut dx);
        self.linearize(time, &state, &dx, &mut df_dt);
        let mut model = LinearModel {
            without_friction: self.matrices(),
            sliders: Vec::new(),
        };
        self.connections.friction_rules = before;
        self.sliders(time, &state, &mut model);
        // The bristles' own damping stands in D so far.
        for pair in &model.sliders {
            for (force, slip) in pair.force.iter().zip(&pair.slip) {
                for (row, f) in force {
                    for (column, g) in slip {
                        model.without_friction.damping[(*row, *column)] -= f * g * pair.slider.damping;
                    }
                }
            }
        }
        // Stuck by the rule, but without friction.
        model.sliders.retain(|pair| pair.slider.limit > 0.0);
        model
    }

    /// Returns the numbers of the pairs of internal states that belong to elements which are no faces.
    pub(super) fn pairs_of_elements(&self) -> Vec<usize> {
        let with_states = self.elements.iter().filter(|own| own.internal_count > 0);
        with_states.map(|own| own.first_internal / 2).collect()
    }

    /// Returns mass matrix, `∂Q/∂q` and `∂Q/∂q˙` of the last linearization. Internal states of elements that
    /// are no faces follow the bodies at once.
    pub(super) fn matrices(&mut self) -> SecondOrder {
        let n = self.layout.speeds;
        let [mut mass, mut stiffness, mut damping] = [(); 3].map(|()| DMatrix::zeros(n, n));
        for (i, row) in self.free.iter().enumerate() {
            let height = row.free.len();
            let own = DMatrix::from_row_slice(height, height, self.jacobian.mass_mut(i));
            mass.view_mut((row.offset, row.offset), (height, height))
                .copy_from(&own);
            for (j, column) in self.free.iter().enumerate() {
                let Some(pair) = self.jacobian.find_pair(i, j) else {
                    continue;
                };
                let width = column.free.len();
                let (k, d) = self.jacobian.blocks_mut(pair);
                for (at, (k, d)) in k.iter().zip(d).enumerate() {
                    let place = (row.offset + at / width, column.offset + at % width);
                    stiffness[place] += *k;
                    damping[place] += *d;
                }
            }
        }
        for group in self.pairs_of_elements() {
            let [a, b, c, d] = *self.jacobian.internal_mut(group);
            let determinant = a * d - b * c;
            // -G⁻¹, by which states follow what drives their rates.
            let follow = [[-d, b], [c, -a]].map(|row| row.map(|own| own / determinant));
            let ends = self.internal_ends[group].clone();
            for (side, &i) in ends.iter().enumerate() {
                let force = self.jacobian.side_mut(group, side)[2].to_vec();
                for (other, &j) in ends.iter().enumerate() {
                    let (height, width) = (self.free[i].free.len(), self.free[j].free.len());
                    let [by_position, by_speed, _] = self.jacobian.side_mut(group, other);
                    for (matrix, by) in [(&mut stiffness, by_position), (&mut damping, by_speed)] {
                        for (r, c) in (0..height).flat_map(|r| (0..width).map(move |c| (r, c))) {
                            let states = follow.map(|[first, second]| first * by[c] + second * by[width + c]);
                            let value = force[r] * states[0] + force[height + r] * states[1];
                            matrix[(self.free[i].offset + r, self.free[j].offset + c)] += value;
                        }
                    }
                }
            }
        }
        SecondOrder {
            mass,
            stiffness,
            damping,
        }
    }

    /// Adds the sliders of closed contacts, from the last linearization; bristles are relaxed in the state.
    fn sliders(&mut self, time: f64, state: &[f64], model: &mut LinearModel) {
        let seen = self.observe(time, state);
        let mut places = vec![None; self.internal_ends.len()];
        for (number, (mounted, found)) in self.faces.iter().zip(&seen.faces).enumerate() {
            let face = &mounted.element;
            let FrictionLaw::Bristle { stiffness, damping } = face.law else {
                continue;
            };
            for (point, (own, at)) in face.points.iter().zip(&found.points).enumerate() {
                places[mounted.first_internal / 2 + point] = Some((
                    SliderPlace::Point { face: number, point },
                    Slider {
                        stiffness: own.share * stiffness,
                        damping: own.share * damping,
                        limit: face.limit_at_rest(point, at.normal),
                    },
                ));
            }
        }
        for (number, (connection, found)) in self.connections.all().iter().zip(&seen.connections).enumerate()
        {
            let (Some(first), Some([stiffness, damping])) = (
                self.connections.deflection_of(number),
                self.connections.bristle_of(number),
            ) else {
                continue;
            };
            let limit = match (&connection.law, &found.wedge) {
                (_, Some(inside)) => inside.friction_limit,
                // The normal forces of a clamp cancel.
                (Law::Surface(own), _) if own.clamped => {
                    own.coefficient * (-own.spring.evaluate(found.extensions[0])).max(0.0)
                }
                (Law::Surface(own), _) => own.coefficient * found.forces[0].abs(),
                _ => continue,
            };
            places[first / 2] = Some((
                SliderPlace::Connection(number),
                Slider {
                    stiffness,
                    damping,
                    limit,
                },
            ));
        }
        for (group, ends) in self.internal_ends.iter().enumerate() {
            let Some((place, slider)) = places[group] else {
                continue;
            };
            let mut slip: [Vec<Entry>; 2] = [Vec::new(), Vec::new()];
            let mut force: [Vec<Entry>; 2] = [Vec::new(), Vec::new()];
            for (side, &end) in ends.iter().enumerate() {
                let free = &self.free[end];
                let width = free.free.len();
                let [_, by_speed, force_t] = self.jacobian.side_mut(group, side);
                for direction in 0..2 {
                    let entries = |row: &[f64], by: f64| -> Vec<Entry> {
                        let own = row[direction * width..][..width].iter().enumerate();
                        own.filter(|(_, value)| **value != 0.0)
                            .map(|(k, value)| (free.offset + k, by * value))
                            .collect()
                    };
                    slip[direction].extend(entries(by_speed, 1.0));
                    force[direction].extend(entries(force_t, 1.0 / slider.stiffness));
                }
            }
            if slip.iter().all(Vec::is_empty) {
                continue;
            }
            model.sliders.push(SlidingPair {
                place,
                slider,
                slip,
                force,
            });
        }
    }
}
