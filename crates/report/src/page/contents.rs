//! The contents of a page: a list of links, from the headings of its main part.

use maud::{Markup, PreEscaped, html};

use super::anchor;

/// Returns the main part with a name on each heading of the second order, and the links to these; no links to
/// fewer than three.
pub(super) fn of(main: &str) -> (String, Option<Markup>) {
    let mut named = String::with_capacity(main.len());
    let mut links: Vec<(String, &str)> = Vec::new();
    let mut rest = main;
    while let Some((before, heading)) = rest.split_once("<h2") {
        let Some(((attributes, title), after)) = heading
            .split_once("</h2>")
            .and_then(|(own, after)| Some((own.split_once('>')?, after)))
        else {
            break;
        };
        let own = attributes
            .split_once("id=\"")
            .and_then(|(_, id)| id.split_once('"'));
        let id = match own {
            Some((id, _)) => id.to_owned(),
            None => free(&anchor(&title.to_lowercase()), &links),
        };
        named.push_str(before);
        named.push_str("<h2");
        named.push_str(attributes);
        if own.is_none() {
            named.push_str(&format!(" id=\"{id}\""));
        }
        named.push_str(&format!(">{title}</h2>"));
        links.push((id, title));
        rest = after;
    }
    named.push_str(rest);
    let list = (links.len() > 2).then(|| {
        html! { ul { @for (id, title) in &links { li { a href={ "#" (id) } { (PreEscaped(title)) } } } } }
    });
    (named, list)
}

/// Returns a name that no heading before has.
fn free(name: &str, links: &[(String, &str)]) -> String {
    let mut own = name.to_owned();
    while links.iter().any(|(other, _)| *other == own) {
        own.push('_');
    }
    own
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn headings_are_named_and_linked() {
        let main = "<h2>Wedges</h2><p>a</p><h2 id=\"x\" class=\"y\">L &amp; V</h2><h2>Wedges</h2><h3>no</h3>";
        let (named, list) = of(main);
        assert_eq!(
            named,
            "<h2 id=\"wedges\">Wedges</h2><p>a</p><h2 id=\"x\" class=\"y\">L &amp; V</h2><h2 id=\"wedges_\">\
             Wedges</h2><h3>no</h3>"
        );
        let list = list.map(Markup::into_string).unwrap_or_default();
        for link in ["\"#wedges\">Wedges<", "\"#x\">L &amp; V<", "\"#wedges_\">"] {
            assert!(list.contains(link), "{link}: {list}");
        }
        assert!(of("<h2>One</h2><h2>Two</h2>").1.is_none(), "two need no contents");
    }
}
