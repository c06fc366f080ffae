//! The friction laws.

use super::*;

// Friction

#[test]
fn tanh_limits_and_smoothness() {
    let (limit, v0) = (30.0, 0.02);
    let mut random = Random(2);
    for _ in 0..500 {
        let v: [f64; 2] = random.vector(0.1);
        let speed = norm(&v);
        let one = tanh::friction(limit, v0, v);
        let size = limit * (speed / v0).tanh();
        for k in 0..2 {
            close(one.force[k], -size * v[k] / speed, 1e-12);
        }
        close(one.loss, size * speed, 1e-12);
        assert_eq!(one.load < 1.0, speed < v0);
        close(one.load, speed / v0, 1e-13);
    }
    // Far beyond the reference speed: the limit, against the velocity; never above it.
    let fast = tanh::friction(limit, v0, [-3.0, 4.0]);
    close(fast.force[0], 18.0, 1e-13);
    close(fast.force[1], -24.0, 1e-13);
    // A dashpot limit/v0 at small velocity, without a jump in value or slope; exactly zero at rest.
    assert_eq!(
        tanh::friction(limit, v0, [0.0, 0.0]).force.map(f64::abs),
        [0.0; 2]
    );
    for v in [1e-300, 1e-20, 1e-9, 1e-7] {
        let force = tanh::friction(limit, v0, [v, 0.0]).force[0];
        close(force / v, -limit / v0, 1e-9 * limit / v0);
    }
    // Value and slope where the series near zero ends (|v|/v0 = sqrt(1e-3)), on both sides of it.
    let edge = v0 * 1e-3f64.sqrt();
    for v in [0.3, 0.999, 1.0 - 1e-12, 1.0 + 1e-12, 1.001, 3.0].map(|factor| factor * edge) {
        let one = tanh::friction(
            Dual::from(limit),
            v0,
            [Dual::<1>::variable(v, 0), Dual::from(0.0)],
        );
        let t = (v / v0).tanh();
        close(one.force[0].value, -limit * t, 1e-14);
        close(one.force[0].derivative[0], -limit / v0 * (1.0 - t * t), 1e-10);
    }
}

#[test]
fn tanh_never_adds_energy() {
    let mut random = Random(3);
    for _ in 0..20_000 {
        let limit = random.between(0.0, 1e5);
        let v0 = 10f64.powf(random.between(-6.0, 0.0));
        let v = random.vector::<2>(1.0).map(|v| v * 10f64.powf(-4.0));
        let one = tanh::friction(limit, v0, v);
        assert!(one.loss >= 0.0);
        assert!(one.force[0] * v[0] + one.force[1] * v[1] <= 0.0);
        assert!(norm(&one.force) <= limit * (1.0 + 1e-15));
        close(
            one.loss,
            -(one.force[0] * v[0] + one.force[1] * v[1]),
            1e-14 * one.loss,
        );
    }
}

#[test]
fn bristle_is_continuous_where_it_begins_to_slip() {
    let (limit, stiffness, damping) = (30.0, 4e4, 90.0);
    let mut random = Random(4);
    for _ in 0..1000 {
        let v: [f64; 2] = random.vector(0.5);
        let angle = random.between(0.0, 2.0 * PI);
        // T = K e + C v with |T| = μN (1 ± tiny)
        let deflection = |factor: f64| {
            let trial = [limit * factor * angle.cos(), limit * factor * angle.sin()];
            [0, 1].map(|k| (trial[k] - damping * v[k]) / stiffness)
        };
        let inside = bristle::friction(limit, stiffness, damping, v, deflection(1.0 - 1e-9));
        let outside = bristle::friction(limit, stiffness, damping, v, deflection(1.0 + 1e-9));
        assert!(inside.load <= 1.0 && outside.load > 1.0);
        for k in 0..2 {
            close(inside.force[k], outside.force[k], 1e-6);
            close(inside.rate[k], outside.rate[k], 1e-8);
            close(inside.rate[k], v[k], 0.0);
        }
        close(inside.loss, outside.loss, 1e-6);
        close(inside.load, 1.0 - 1e-9, 1e-12);
        close(outside.load, 1.0 + 1e-9, 1e-12);
    }
}

#[test]
fn bristle_losses_and_forces() {
    let mut random = Random(5);
    let mut both = [0; 2];
    for _ in 0..20_000 {
        let stiffness = 10f64.powf(random.between(2.0, 8.0));
        let damping = 10f64.powf(random.between(0.0, 5.0));
        let limit = 10f64.powf(random.between(-1.0, 5.0));
        let v: [f64; 2] = random.vector(2.0 * limit / damping);
        let e: [f64; 2] = random.vector(2.0 * limit / stiffness);
        let one = bristle::friction(limit, stiffness, damping, v, e);
        both[usize::from(one.load <= 1.0)] += 1;
        // F·v = -d/dt (K e²/2) - loss
        let power = one.force[0] * v[0] + one.force[1] * v[1];
        let stored = stiffness * (e[0] * one.rate[0] + e[1] * one.rate[1]);
        let size = power.abs() + stored.abs() + one.loss;
        close(power, -stored - one.loss, 1e-13 * size);
        assert!(one.loss >= 0.0);
        assert!(norm(&one.force) <= limit * (1.0 + 1e-14));
        // The defining equations.
        let trial = [0, 1].map(|k| stiffness * e[k] + damping * v[k]);
        if norm(&trial) <= limit {
            assert!(one.load <= 1.0);
            assert_eq!(one.rate, v);
            for k in 0..2 {
                close(one.force[k], -trial[k], 1e-15 * limit);
            }
        } else {
            assert!(one.load > 1.0);
            for k in 0..2 {
                let slider = limit * trial[k] / norm(&trial);
                close(one.force[k], -slider, 1e-13 * limit);
                close(
                    damping * one.rate[k],
                    slider - stiffness * e[k],
                    1e-13 * (limit + stiffness * e[k].abs()),
                );
            }
        }
    }
    assert!(both[0] > 1000 && both[1] > 1000);
    // No limit: no force, the bristle relaxes.
    let open = bristle::friction(0.0, 100.0, 5.0, [1.0, -2.0], [0.3, 0.4]);
    assert_eq!(open.force.map(f64::abs), [0.0; 2]);
    close(open.rate[0], -6.0, 1e-14);
    close(open.rate[1], -8.0, 1e-14);
    close(open.loss, 5.0 * 100.0, 1e-12);
}

#[test]
fn creep_speeds_of_the_laws() {
    let tanh_law = FrictionLaw::Tanh {
        reference_speed: 0.02,
    };
    for load in [0.0, 0.1, 0.5, 0.9, 0.999] {
        let speed = tanh_law.creep_speed(load);
        // At this speed the law carries this load.
        close(-tanh::friction(1.0, 0.02, [speed, 0.0]).force[0], load, 1e-13);
    }
    // 1/2 ln 3 v0 at half the limit
    close(tanh_law.creep_speed(0.5), 0.02 * 0.549_306_144_334_054_8, 1e-16);
    let bristle = FrictionLaw::Bristle {
        stiffness: 1e6,
        damping: 1e3,
    };
    assert_eq!(bristle.creep_speed(0.9), 0.0);
    assert_eq!(tanh_law.states_per_point(), 0);
    assert_eq!(bristle.states_per_point(), 2);
}
