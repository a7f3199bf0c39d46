//! IES TM-27: one spectrum as XML (`.spdx`).
//!
//! ANSI/IES TM-27-14 and TM-27-20, "IES Standard Format for the Electronic Transfer of Spectral Data". The
//! format has one spectrum and the header of one product; files with several, which it does not provide for,
//! are read all the same. Entities and document types are refused, so that a small file cannot expand into a
//! large one.

use std::fmt::Write;

use roxmltree::{Document, Node, ParsingOptions};

use super::place::{Place, finite};
use super::quantity::Quantity;
use super::table::{Stated, Table};
use super::units;
use crate::error::{Result, counted};
use crate::markup::escaped;
use crate::spectrum::Spectrum;

/// More nodes than any spectrum has: a tree takes many times the memory of its text.
const MAX_NODES: u32 = 1_000_000;
/// Maximum nesting of elements: the standard has three levels, and the recursive parser must not run out of
/// stack.
const MAX_DEPTH: usize = 64;
/// Maximum number of attributes: the standard has two, and the parser compares each with all others.
const MAX_ATTRIBUTES: usize = 100;

/// The spectrum of a TM-27 text; several are named by their number.
///
/// # Errors
/// [`crate::Error::Table`] with the offending line.
pub(super) fn parse(path: &str, text: &str) -> Result<Table> {
    let at = |line| Place { path, line };
    if let Some((line, problem)) = overgrown(text) {
        return Err(at(line).fails(problem, "export the file again"));
    }
    let options = ParsingOptions { nodes_limit: MAX_NODES, ..ParsingOptions::default() };
    let document = Document::parse_with_options(text, options).map_err(|e| {
        at(e.pos().row as usize).fails(format!("not readable XML ({e})"), "export the file again")
    })?;
    let place = |node: Node| at(document.text_pos_at(node.range().start).row as usize);
    let root = document.root_element();
    if !root.tag_name().name().starts_with("IESTM27") {
        let problem = format!("found <{}> instead of <IESTM2714>", root.tag_name().name());
        return Err(place(root).fails(problem, "export the spectrum as IES TM-27"));
    }
    let blocks: Vec<Node> = children(root, "SpectralDistribution").collect();
    let (mut spectra, mut stated) = (Vec::new(), Vec::new());
    for (n, block) in blocks.iter().enumerate() {
        let name = if blocks.len() == 1 { "spectrum".to_owned() } else { (n + 1).to_string() };
        spectra.push(distribution(name, *block, place)?);
        let quantity = children(*block, "SpectralQuantity").next().and_then(|node| node.text());
        stated.push(Stated { quantity: quantity.and_then(Quantity::called), ..Stated::default() });
    }
    if spectra.is_empty() {
        return Err(place(root).fails("no <SpectralDistribution>", "export the spectrum again"));
    }
    Ok(Table { stated, ..Table::new(spectra)? })
}

fn distribution<'a>(name: String, block: Node, place: impl Fn(Node) -> Place<'a>) -> Result<Spectrum> {
    let (mut wavelengths, mut values) = (Vec::new(), Vec::new());
    for data in children(block, "SpectralData") {
        // locating an element means reading the text up to it, so this is done only for errors
        let number = |name: &str, text: Option<&str>| {
            let text = text.unwrap_or("").trim();
            finite(text).map_or_else(|| place(data).number(name, text), Ok)
        };
        wavelengths.push(number("wavelength", data.attribute("wavelength"))?);
        values.push(number("SpectralData", data.text())?);
    }
    let at = place(block);
    if values.len() < 2 {
        let problem = format!("{} <SpectralData>", counted(values.len(), "element"));
        return Err(at.fails(problem, "a spectrum needs at least two wavelengths"));
    }
    let (wavelengths_nm, _) = units::to_nm(at, "nm", &wavelengths, at.line)?;
    Ok(Spectrum::from_table(name, wavelengths_nm.into(), values))
}

fn children<'a>(node: Node<'a, 'a>, name: &'static str) -> impl Iterator<Item = Node<'a, 'a>> {
    node.children().filter(move |child| child.tag_name().name() == name)
}

/// The first line, if any, on which elements are nested too deeply or have too many attributes, with the
/// problem.
fn overgrown(text: &str) -> Option<(usize, String)> {
    let mut depth = 0_usize;
    let opens = |tag: &str| {
        !tag.starts_with(['/', '!', '?']) && !tag.split('>').next().is_some_and(|tag| tag.ends_with('/'))
    };
    // a value is in quotes after an equals sign, and contains no '<'
    let attributes = |tag: &str| {
        tag.split('=').skip(1).filter(|behind| behind.trim_start().starts_with(['"', '\''])).count()
    };
    let mut line = 1;
    for (n, tag) in text.split('<').enumerate() {
        match tag {
            _ if n == 0 => {}
            tag if tag.starts_with('/') => depth = depth.saturating_sub(1),
            tag if opens(tag) => depth += 1,
            _ => {}
        }
        if depth > MAX_DEPTH {
            return Some((line, format!("elements nested more than {MAX_DEPTH} deep")));
        }
        if attributes(tag) > MAX_ATTRIBUTES {
            return Some((line, format!("an element with more than {MAX_ATTRIBUTES} attributes")));
        }
        line += tag.matches('\n').count();
    }
    None
}

/// A reflectance as TM-27-14; `created` is the date, such as `2026-01-31T12:00:00Z`.
pub(super) fn text(name: &str, created: &str, wavelengths_nm: &[f64], reflectance: &[f64]) -> String {
    let mut data = String::new();
    for (nm, value) in wavelengths_nm.iter().zip(reflectance) {
        // writing to a String cannot fail
        let _ = writeln!(data, "    <SpectralData wavelength=\"{nm}\">{value}</SpectralData>");
    }
    format!(
        "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
         <IESTM2714 xmlns=\"http://www.ies.org/iestm2714\" version=\"1.0\">\n\
         \x20 <Header>\n\
         \x20   <Description>{}</Description>\n\
         \x20   <DocumentCreator>vfold</DocumentCreator>\n\
         \x20   <DocumentCreationDate>{created}</DocumentCreationDate>\n\
         \x20 </Header>\n\
         \x20 <SpectralDistribution>\n\
         \x20   <SpectralQuantity>reflectance</SpectralQuantity>\n\
         {data}\x20 </SpectralDistribution>\n\
         </IESTM2714>\n",
        escaped(name)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(data: &str) -> String {
        format!(
            "<?xml version=\"1.0\"?>\n<IESTM2714 xmlns=\"http://www.ies.org/iestm2714\">\n\
             <SpectralDistribution>{data}</SpectralDistribution></IESTM2714>"
        )
    }

    fn datum(nm: &str, value: &str) -> String {
        format!("<SpectralData wavelength=\"{nm}\">{value}</SpectralData>\n")
    }

    #[test]
    fn what_is_written_is_read() {
        let (nm, reflectance) = ([400.0, 402.5, 700.0], [0.1, 1.0 / 3.0, 0.9]);
        let text = text("red <& dark>", "2026-01-31T12:00:00Z", &nm, &reflectance);
        let spectrum = parse("x.spdx", &text).unwrap().spectra.remove(0);
        assert_eq!((spectrum.wavelengths_nm(), spectrum.values()), (&nm[..], &reflectance[..]));
        assert!(text.contains("<Description>red &lt;&amp; dark&gt;</Description>"));
    }

    #[test]
    fn several_are_called_by_their_number() {
        let two = datum("400", "0.1") + &datum("500", "0.2");
        let other =
            format!("<SpectralDistribution>{}</SpectralDistribution></IESTM", two.replace("0.2", "0.3"));
        let spectra = parse("x.spdx", &file(&two).replace("</IESTM", &other)).unwrap().spectra;
        let found: Vec<_> = spectra.iter().map(|spectrum| (spectrum.name(), spectrum.values())).collect();
        assert_eq!(found, [("1", &[0.1, 0.2][..]), ("2", &[0.1, 0.3])]);
    }

    #[test]
    fn files_that_are_no_spectrum_are_refused() {
        let two = datum("400", "0.1") + &datum("500", "0.2");
        for (text, want) in [
            (String::new(), "x.spdx:1: not readable XML"),
            ("<a></b>".to_owned(), "x.spdx:1: not readable XML"),
            ("<item/>".to_owned(), "<item> instead of <IESTM2714>"),
            (file(""), "x.spdx:3: 0 elements <SpectralData>"),
            (file(&datum("400", "0.1")), "1 element <"),
            (file(&(two.clone() + &datum("450", "0.1"))), "450 nm follows 500 nm"),
            (
                file(&(two.clone() + &datum("600", "NaN"))),
                "x.spdx:5: column 'SpectralData': 'NaN' is not a number",
            ),
            (file(&(two.clone() + &datum("", "1"))), "column 'wavelength': '' is not a number"),
            (file(&(two.clone() + &datum("600", "1e308"))), "is too large"),
            ("<IESTM2714/>".to_owned(), "x.spdx:1: no <SpectralDistribution>"),
            (
                file(&two).replace("</IESTM", "<SpectralDistribution/></IESTM"),
                "x.spdx:5: 0 elements <SpectralData>",
            ),
            (format!("<!DOCTYPE a [<!ENTITY b \"c\">]>{}", file(&two)), "not readable XML"),
            (format!("<!DOCTYPE a SYSTEM \"file:///etc/passwd\">{}", file(&two)), "not readable XML"),
            (file(&"<a>".repeat(1_000_000)), "nested more than 64 deep"),
            (file(&"<a/>".repeat(1_100_000)), "not readable XML"),
            (
                file(&format!("<a {}/>", "b='1' ".repeat(200_000))),
                "x.spdx:3: an element with more than 100 attributes",
            ),
        ] {
            let message = parse("x.spdx", &text).unwrap_err().to_string();
            assert!(message.contains(want), "{want}: {}", &message[..message.len().min(300)]);
        }
    }
}
