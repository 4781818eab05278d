//! A table once, for a terminal, for a page and for a document.

use std::fmt::Write;

use comfy_table::{CellAlignment, ContentArrangement, Table, presets};
use mufasa_drives::pictures::escape;

/// A table of texts.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Rows {
    /// Of every column, with whether it holds numbers.
    header: Vec<(&'static str, bool)>,
    rows: Vec<Vec<String>>,
}

/// A column: its name, whether it holds numbers, and what a row has there.
pub(crate) type Column<R> = (&'static str, bool, fn(&R) -> String);

pub(crate) const fn text<R>(name: &'static str, cell: fn(&R) -> String) -> Column<R> {
    (name, false, cell)
}

pub(crate) const fn number<R>(name: &'static str, cell: fn(&R) -> String) -> Column<R> {
    (name, true, cell)
}

pub(crate) fn rows<R>(of: &[R], columns: &[Column<R>]) -> Rows {
    let header = columns.iter().map(|(name, is_number, _)| (*name, *is_number)).collect();
    let row = |row: &R| columns.iter().map(|(.., cell)| cell(row)).collect();
    Rows { header, rows: of.iter().map(row).collect() }
}

impl Rows {
    /// For a terminal.
    pub fn text(&self) -> String {
        self.on(&mut Table::new())
    }

    /// For a terminal, no wider than so many characters.
    pub fn text_within(&self, width: u16) -> String {
        let mut table = Table::new();
        table.set_content_arrangement(ContentArrangement::Dynamic).set_width(width);
        self.on(&mut table)
    }

    fn on(&self, table: &mut Table) -> String {
        table.load_style(presets::UTF8_FULL_CONDENSED);
        table.set_header(self.header.iter().map(|(name, _)| *name));
        for row in &self.rows {
            table.add_row(row);
        }
        for (column, (_, is_number)) in table.column_iter_mut().zip(&self.header) {
            if *is_number {
                column.set_cell_alignment(CellAlignment::Right);
            }
        }
        format!("{table}\n")
    }

    /// For a page.
    pub fn html(&self) -> String {
        let mut out = String::from("<table>\n<tr>");
        for (name, _) in &self.header {
            // A string takes whatever is written.
            let _ = write!(out, "<th>{}</th>", escape(name));
        }
        out.push_str("</tr>\n");
        for row in &self.rows {
            out.push_str("<tr>");
            for (cell, (_, is_number)) in row.iter().zip(&self.header) {
                let class = if *is_number { " class=\"number\"" } else { "" };
                let _ = write!(out, "<td{class}>{}</td>", escape(cell));
            }
            out.push_str("</tr>\n");
        }
        out.push_str("</table>\n");
        out
    }

    /// For a document.
    pub fn markdown(&self) -> String {
        let names: Vec<&str> = self.header.iter().map(|(name, _)| *name).collect();
        let mut out = format!("| {} |\n|", names.join(" | "));
        for (_, is_number) in &self.header {
            out.push_str(if *is_number { "--:|" } else { "---|" });
        }
        out.push('\n');
        for row in &self.rows {
            // A string takes whatever is written.
            let _ = writeln!(out, "| {} |", row.join(" | "));
        }
        out
    }
}
