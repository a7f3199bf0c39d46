//! Elements of a page. All text is escaped: names of samples may contain anything.

use crate::markup::escaped;

/// A piece of a page.
#[derive(Clone, Debug, Default)]
pub(super) struct Html(String);

impl Html {
    /// An element with its attributes.
    pub fn element(name: &str, attributes: &[(&str, &str)], content: impl Into<Self>) -> Self {
        Self(format!("<{name}{}>{}</{name}>", written(attributes), content.into().0))
    }

    /// An element without content.
    pub fn empty(name: &str, attributes: &[(&str, &str)]) -> Self {
        Self(format!("<{name}{}/>", written(attributes)))
    }

    /// The style sheet of the page.
    pub fn style(rules: &'static str) -> Self {
        Self(format!("<style>{rules}</style>"))
    }

    /// A drawing from `plot`, as wide as the page, with a description for those who cannot see it.
    pub fn drawing(svg: &str, words: &str) -> Self {
        let described = format!("<svg role=\"img\" aria-label=\"{}\" ", escaped(words));
        Self(svg.replacen("<svg ", &described, 1))
    }

    /// Lines of text, for an element that preserves them.
    pub fn lines(text: &str) -> Self {
        Self(text.lines().map(escaped).collect::<Vec<_>>().join("\n"))
    }

    /// Columns under their headings; the first names the rows.
    pub fn table(caption: &str, headings: &[&str], rows: impl IntoIterator<Item = Vec<Self>>) -> Self {
        let heading = |text: &&str| Self::element("th", &[("scope", "col")], *text);
        let head = Self::element("tr", &[], headings.iter().map(heading).collect::<Vec<_>>());
        let cell = |(column, content): (usize, Self)| match column {
            0 => Self::element("th", &[("scope", "row")], content),
            _ => Self::element("td", &[], content),
        };
        let row = |cells: Vec<Self>| {
            Self::element("tr", &[], cells.into_iter().enumerate().map(cell).collect::<Vec<_>>())
        };
        let body: Vec<_> = rows.into_iter().map(row).collect();
        let parts = vec![
            Self::element("caption", &[], caption),
            Self::element("thead", &[], head),
            Self::element("tbody", &[], body),
        ];
        Self::element("div", &[("class", "table")], Self::element("table", &[], parts))
    }

    /// A drawing above its caption.
    pub fn figure(drawing: Self, caption: &str) -> Self {
        Self::element("figure", &[], vec![drawing, Self::element("figcaption", &[], caption)])
    }

    pub fn into_string(self) -> String {
        self.0
    }
}

impl From<&str> for Html {
    fn from(text: &str) -> Self {
        Self(escaped(text))
    }
}

impl From<String> for Html {
    fn from(text: String) -> Self {
        text.as_str().into()
    }
}

impl From<Vec<Self>> for Html {
    fn from(parts: Vec<Self>) -> Self {
        Self(parts.into_iter().map(|part| part.0).collect())
    }
}

fn written(attributes: &[(&str, &str)]) -> String {
    attributes.iter().map(|(name, value)| format!(" {name}=\"{}\"", escaped(value))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn text_stays_text() {
        let html = Html::element("p", &[("title", "\" onload=\"x")], "<script>&\0</script>");
        let expected = "<p title=\"&quot; onload=&quot;x\">&lt;script&gt;&amp;\\u{0}&lt;/script&gt;</p>";
        assert_eq!(html.into_string(), expected);
    }
}
