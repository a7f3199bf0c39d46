//! Matrices of the bispectrometer Labsphere BFC-450 as exported by its program: lines about the sample, then
//! a tab-separated table that begins with `r:c:`, with emission in rows and excitation in columns, nm.

use super::csv;
use super::place::Place;
use super::table::Table;
use crate::error::Result;

/// The cell above the wavelengths of emission and before those of excitation.
const CORNER: &str = "r:c:";

/// True if a text is such a file.
pub(super) fn is_matrix(text: &str) -> bool {
    text.lines().any(|line| line.starts_with(CORNER))
}

/// The columns of the matrix, named after their excitation.
///
/// # Errors
/// [`crate::Error::Table`] with the offending line and column.
pub(super) fn parse(path: &str, text: &str) -> Result<Table> {
    let above = text.lines().take_while(|line| !line.starts_with(CORNER)).count();
    // the line of excitation wavelengths ends in a tab
    let table: Vec<_> = text.lines().skip(above).map(str::trim_end).collect();
    csv::parse_from(Place { path, line: above + 1 }, &table.join("\n"))
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "VEC_01\t6\nBFC-450 Matrix File\n;a sheet\n400\t410\t10\t3\t390\t10\n\
                        r:c:\t390\t400\t410\t\n400\t0.01\t0.5\t0\n410\t0.2\t0.01\t0.6\n";

    #[test]
    fn columns_are_called_after_their_excitation() {
        assert!(is_matrix(TEXT) && !is_matrix("nm,r\n400,0.1\n"));
        let columns = parse("a.BFC", TEXT).unwrap().spectra;
        assert_eq!((columns[0].name(), columns[0].values()), ("390", &[0.01, 0.2][..]));
        assert_eq!(columns[0].wavelengths_nm(), [400.0, 410.0]);
        let message = parse("a.BFC", &TEXT.replace("0.6", "-")).unwrap_err().to_string();
        assert!(message.starts_with("a.BFC:7: column '410': '-' is not a number"), "{message}");
    }
}
