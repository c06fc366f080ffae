//! Elements and attributes of XML, with what both descriptions share.

use std::io::Cursor;

use quick_xml::Writer;
use quick_xml::events::{BytesDecl, BytesEnd, BytesStart, Event};

use crate::Error;
use crate::unit::Unit;

/// Writes XML, two blanks a level.
pub(crate) struct Xml {
    writer: Writer<Cursor<Vec<u8>>>,
}

/// Attributes: names and values.
pub(crate) type Attributes<'a> = Vec<(&'a str, String)>;

impl Xml {
    pub fn new() -> Result<Self, Error> {
        let mut writer = Writer::new_with_indent(Cursor::new(Vec::new()), b' ', 2);
        writer
            .write_event(Event::Decl(BytesDecl::new("1.0", Some("UTF-8"), None)))
            .map_err(failed)?;
        Ok(Self { writer })
    }

    /// Writes an element without content.
    pub fn empty(&mut self, name: &str, attributes: &[(&str, String)]) -> Result<(), Error> {
        self.event(Event::Empty(start(name, attributes)))
    }

    /// Writes an element around others.
    pub fn element(
        &mut self,
        name: &str,
        attributes: &[(&str, String)],
        inside: impl FnOnce(&mut Self) -> Result<(), Error>,
    ) -> Result<(), Error> {
        self.event(Event::Start(start(name, attributes)))?;
        inside(self)?;
        self.event(Event::End(BytesEnd::new(name)))
    }

    pub fn finish(self) -> Result<String, Error> {
        let bytes = self.writer.into_inner().into_inner();
        let text = String::from_utf8(bytes).map_err(Error::of)?;
        Ok(text + "\n")
    }

    fn event(&mut self, event: Event<'_>) -> Result<(), Error> {
        self.writer.write_event(event).map_err(failed)
    }

    /// Writes the units, the same in both versions.
    pub fn units(&mut self) -> Result<(), Error> {
        self.element("UnitDefinitions", &[], |xml| {
            for unit in Unit::ALL {
                let Some(name) = unit.name() else { continue };
                xml.element("Unit", &[("name", name.to_owned())], |xml| {
                    xml.empty("BaseUnit", &unit.base())?;
                    match unit.display() {
                        Some(display) => xml.empty(
                            "DisplayUnit",
                            &[
                                ("name", display.name.to_owned()),
                                ("factor", number(display.factor)),
                            ],
                        ),
                        None => Ok(()),
                    }
                })?;
            }
            Ok(())
        })
    }
}

fn start<'n>(name: &'n str, attributes: &[(&str, String)]) -> BytesStart<'n> {
    let mut start = BytesStart::new(name);
    for (key, value) in attributes {
        start.push_attribute((*key, value.as_str()));
    }
    start
}

fn failed(error: std::io::Error) -> Error {
    Error::new(format!("the model description cannot be written: {error}"))
}

/// Returns a number that reads back to the last bit.
pub(crate) fn number(value: f64) -> String {
    format!("{value:?}")
}

/// References, as lists in attributes have them.
pub(crate) fn list(references: impl Iterator<Item = u32>) -> String {
    references.map(|r| r.to_string()).collect::<Vec<_>>().join(" ")
}
