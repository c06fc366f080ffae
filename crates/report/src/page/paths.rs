//! Lines of drawings with fewer signs: each point counts from the one before, in tenths of a pixel, and
//! points that nobody sees are left out.

/// Distance from a line at which a point is not seen, tenths of a pixel: a sixth of its width.
const TOLERANCE: f64 = 2.5;
/// The beginning of a path.
const BEFORE: &str = " d=\"M ";

/// Returns a drawing whose lines of straight pieces are written so; all else stays.
pub(super) fn shortened(svg: &str) -> String {
    let mut out = String::with_capacity(svg.len());
    let mut pieces = svg.split(BEFORE);
    out.push_str(pieces.next().unwrap_or_default());
    for piece in pieces {
        let (path, rest) = piece.split_once('"').unwrap_or((piece, ""));
        match line(path) {
            Some(line) => out.push_str(&format!(" d=\"{line}\"{rest}")),
            None => out.push_str(&format!("{BEFORE}{path}\"{rest}")),
        }
    }
    out
}

/// Returns lines, such as `1 2 L 3 4 M 5 6 L 7 8` after their first `M`, anew; `None` if there is anything
/// else.
fn line(path: &str) -> Option<String> {
    let mut out = String::new();
    for part in path.split('M') {
        let points: Option<Vec<(i64, i64)>> = part.split('L').map(point).collect();
        let points = straightened(&points?);
        let ((x, y), others) = points.split_first()?;
        out.push_str(&format!("M{}", tenths(*x)));
        push(&mut out, *y);
        let (mut before, mut command) = ((*x, *y), "l");
        for (x, y) in others {
            out.push_str(command);
            let (dx, dy) = (x - before.0, y - before.1);
            if command.is_empty() {
                push(&mut out, dx);
            } else {
                out.push_str(&tenths(dx));
            }
            push(&mut out, dy);
            (before, command) = ((*x, *y), "");
        }
    }
    Some(out)
}

/// Returns a point in tenths of a pixel.
fn point(text: &str) -> Option<(i64, i64)> {
    let mut numbers = text.split_whitespace().map(|number| number.parse::<f64>().ok());
    let (x, y) = (numbers.next()??, numbers.next()??);
    let tenth = |value: f64| (value.abs() < 1e9).then(|| (10.0 * value).round() as i64);
    match numbers.next() {
        None => Some((tenth(x)?, tenth(y)?)),
        Some(_) => None,
    }
}

/// Leaves out points from which the line without them is nearer than [`TOLERANCE`] (Douglas and Peucker).
fn straightened(points: &[(i64, i64)]) -> Vec<(i64, i64)> {
    let Some(last) = points.len().checked_sub(1) else {
        return Vec::new();
    };
    let mut kept = vec![false; points.len()];
    (kept[0], kept[last]) = (true, true);
    let mut pieces = vec![(0, last)];
    while let Some((from, to)) = pieces.pop() {
        let inside = from + 1..to;
        let far = inside.map(|own| (distance_squared(points[own], [points[from], points[to]]), own));
        let Some((most, own)) = far.max_by(|(a, _), (b, _)| a.total_cmp(b)) else {
            continue;
        };
        if most > TOLERANCE * TOLERANCE {
            kept[own] = true;
            pieces.extend([(from, own), (own, to)]);
        }
    }
    let pairs = points.iter().zip(kept);
    pairs.filter(|(_, kept)| *kept).map(|(point, _)| *point).collect()
}

/// Returns the square of the distance of a point from a straight piece.
fn distance_squared((x, y): (i64, i64), [from, to]: [(i64, i64); 2]) -> f64 {
    let vector = |to: (i64, i64)| [(to.0 - from.0) as f64, (to.1 - from.1) as f64];
    let (own, piece) = (vector((x, y)), vector(to));
    let length = piece[0] * piece[0] + piece[1] * piece[1];
    let along = match length > 0.0 {
        true => ((own[0] * piece[0] + own[1] * piece[1]) / length).clamp(0.0, 1.0),
        false => 0.0,
    };
    let apart = [0, 1].map(|k| own[k] - along * piece[k]);
    apart[0] * apart[0] + apart[1] * apart[1]
}

/// Appends a number, parted from the one before.
fn push(out: &mut String, number: i64) {
    if number >= 0 {
        out.push(' ');
    }
    out.push_str(&tenths(number));
}

/// Returns tenths as a number without zeros that say nothing.
fn tenths(number: i64) -> String {
    let sign = if number < 0 { "-" } else { "" };
    match (number.unsigned_abs() / 10, number.unsigned_abs() % 10) {
        (whole, 0) => format!("{sign}{whole}"),
        (0, tenth) => format!("{sign}.{tenth}"),
        (whole, tenth) => format!("{sign}{whole}.{tenth}"),
    }
}

#[cfg(test)]
mod tests {
    use super::shortened;

    #[test]
    fn issue_048_lines_count_from_point_to_point() {
        let own = |path: &str| shortened(&format!("<path d=\"{path}\" stroke=\"a\"/>"));
        let line = own("M 84.60000000000001 196.1 L 159.6 196.1 L 160 190 L 161 195.5");
        assert_eq!(line, "<path d=\"M84.6 196.1l75 0 .4-6.1 1 5.5\" stroke=\"a\"/>");
        assert_eq!(
            own("M 1 1 L 2 2 L 2 2 L 3 3 L 2 2"),
            "<path d=\"M1 1l2 2-1-1\" stroke=\"a\"/>"
        );
        let bend = own("M 0 0 L 10 0.2 L 20 0 L 30 0.3 L 40 0");
        assert_eq!(
            bend, "<path d=\"M0 0l30 .3 10-.3\" stroke=\"a\"/>",
            "a sixth of a line's width is not seen"
        );
        assert_eq!(
            own("M 0 0 L 1 0 M 5 5 L 5 6"),
            "<path d=\"M0 0l1 0M5 5l0 1\" stroke=\"a\"/>"
        );
        for other in ["M 1 1 A 2 2 0 0 1 3 3", "M 1 1 L 2 2 Z", "M 1 NaN L 2 2"] {
            assert_eq!(own(other), format!("<path d=\"{other}\" stroke=\"a\"/>"));
        }
    }
}
