//! Random numbers by place, not in a row: the same for every order and number of workers.

/// 64 random bits for a seed and some numbers: the finalizer of SplitMix64 (Steele, Lea and Flood, 2014),
/// once a number.
pub(crate) fn mix(seed: u64, numbers: &[u64]) -> u64 {
    let mut state = finalize(seed.wrapping_add(0x9e37_79b9_7f4a_7c15));
    for number in numbers {
        state = finalize(state ^ number.wrapping_add(0x9e37_79b9_7f4a_7c15));
    }
    state
}

fn finalize(mut z: u64) -> u64 {
    z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
    z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
    z ^ (z >> 31)
}

/// Returns a number from 0 to below 1.
pub(super) fn unit(bits: u64) -> f64 {
    (bits >> 11) as f64 / (1_u64 << 53) as f64
}
