//! "Did you mean ...?"

/// Returns the candidate nearest to what was typed, if one is near enough to be worth naming.
///
/// Nearness counts inserted, left-out, changed and swapped letters, whatever their case; up to
/// two in five may differ. If there is none, the shortest that begins with three or more letters typed.
pub fn nearest<'a>(typed: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Nothing that has a name is so long, and the time grows with the length.
    const LONGEST: usize = 200;
    if typed.len() > LONGEST {
        return None;
    }
    let typed: Vec<char> = typed.to_lowercase().chars().collect();
    let candidates = candidates
        .into_iter()
        .filter(|candidate| candidate.len() <= LONGEST);
    let candidates: Vec<(&str, Vec<char>)> = candidates
        .map(|candidate| (candidate, candidate.to_lowercase().chars().collect()))
        .collect();
    let near = candidates
        .iter()
        .filter_map(|(candidate, letters)| {
            let longer = typed.len().max(letters.len());
            let limit = if longer == 1 { 0 } else { (longer * 2 / 5).max(1) };
            if typed.len().abs_diff(letters.len()) > limit {
                return None;
            }
            let distance = distance(&typed, letters);
            (distance <= limit).then_some((distance, *candidate))
        })
        .min_by_key(|(distance, _)| *distance);
    let beginning = || {
        let long = typed.len() >= 3;
        let mut beginning: Vec<&(&str, Vec<char>)> = candidates.iter().collect();
        beginning.retain(|(_, letters)| long && letters.starts_with(&typed));
        beginning.into_iter().min_by_key(|(_, letters)| letters.len())
    };
    near.map(|(_, candidate)| candidate)
        .or_else(|| beginning().map(|(candidate, _)| *candidate))
}

/// Optimal string alignment distance.
fn distance(a: &[char], b: &[char]) -> usize {
    let width = b.len() + 1;
    let mut table = vec![0; (a.len() + 1) * width];
    for i in 0..=a.len() {
        for j in 0..=b.len() {
            table[i * width + j] = if i == 0 || j == 0 {
                i + j
            } else {
                let changed = usize::from(a[i - 1] != b[j - 1]);
                let mut best = (table[(i - 1) * width + j] + 1)
                    .min(table[i * width + j - 1] + 1)
                    .min(table[(i - 1) * width + j - 1] + changed);
                if i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] {
                    best = best.min(table[(i - 2) * width + j - 2] + 1);
                }
                best
            };
        }
    }
    table[a.len() * width + b.len()]
}

#[cfg(test)]
mod tests {
    use super::nearest;

    #[test]
    fn finds_the_near_and_leaves_the_far() {
        let keys = ["stiffness", "damping", "free_length"];
        assert_eq!(nearest("stifness", keys), Some("stiffness"));
        assert_eq!(nearest("dampnig", keys), Some("damping"));
        assert_eq!(nearest("free_lenght", keys), Some("free_length"));
        assert_eq!(nearest("colour", keys), None);
        assert_eq!(nearest("LBF", ["in", "lbf"]), Some("lbf"));
        assert_eq!(nearest("q", ["m", "s"]), None);
    }
}
