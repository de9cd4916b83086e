//! Compares the ports of a verilated module with its interface.

use crate::layout::Signal;
use std::collections::BTreeMap;
use thiserror::Error;
use wheatstone_golden::interface::Direction;

/// The module's ports are not those of its interface.
#[derive(Clone, Debug, Error, PartialEq, Eq)]
pub enum PortError {
    /// The module has no such port.
    #[error("module {module} has no port {port}; its interface has one of {bits} bits")]
    Missing {
        /// The module.
        module: String,
        /// The port.
        port: String,
        /// Width in the interface.
        bits: u32,
    },
    /// The port has another width.
    #[error("port {port} of module {module} has {found} bits, its interface says {expected}")]
    Width {
        /// The module.
        module: String,
        /// The port.
        port: String,
        /// Width in the interface.
        expected: u32,
        /// Width in the Verilog.
        found: u32,
    },
    /// The port has the other direction.
    #[error("port {port} of module {module} has the wrong direction")]
    Direction {
        /// The module.
        module: String,
        /// The port.
        port: String,
    },
    /// The interface has no such port: nobody would drive it or look at it.
    #[error("module {module} has a port {port} of {found} bits that its interface lacks")]
    Unknown {
        /// The module.
        module: String,
        /// The port.
        port: String,
        /// Width in the Verilog.
        found: u32,
    },
}

/// Checks the ports that Verilator's header declares against those expected.
pub(crate) fn check(module: &str, expected: &[Signal], header: &str) -> Result<(), PortError> {
    let mut found: BTreeMap<&str, (u32, Direction)> = header.lines().filter_map(port).collect();
    let module = || module.to_owned();
    for Signal { name, bits, direction } in expected {
        let port = name.clone();
        match found.remove(name.as_str()) {
            None => return Err(PortError::Missing { module: module(), port, bits: *bits }),
            Some((width, _)) if width != *bits => {
                let (expected, found) = (*bits, width);
                return Err(PortError::Width { module: module(), port, expected, found });
            }
            Some((_, other)) if other != *direction => {
                return Err(PortError::Direction { module: module(), port });
            }
            Some(_) => (),
        }
    }
    match found.pop_first() {
        None => Ok(()),
        Some((port, (found, _))) => {
            Err(PortError::Unknown { module: module(), port: port.to_owned(), found })
        }
    }
}

/// A port of a line such as `VL_IN8(&rst_i,0,0);` or `VL_OUTW(&x_o,79,0,3);`.
fn port(line: &str) -> Option<(&str, (u32, Direction))> {
    let line = line.trim();
    let direction = if line.starts_with("VL_IN") && !line.starts_with("VL_INOUT") {
        Direction::Input
    } else if line.starts_with("VL_OUT") || line.starts_with("VL_INOUT") {
        Direction::Output
    } else {
        return None;
    };
    let (_, arguments) = line.split_once("(&")?;
    let mut arguments = arguments.split([',', ')']);
    let name = arguments.next()?;
    let msb: i32 = arguments.next()?.parse().ok()?;
    let lsb: i32 = arguments.next()?.parse().ok()?;
    Some((name, (msb.abs_diff(lsb) + 1, direction)))
}

#[cfg(test)]
mod tests {
    use super::*;

    const HEADER: &str = "
    VL_IN8(&clk_i,0,0);
    VL_IN16(&x_i,10,0);
    VL_OUT(&x_o,10,-14);
    VL_OUTW(&wide_o,79,0,3);
    V___024root* const rootp;";

    fn signal(name: &str, bits: u32, direction: Direction) -> Signal {
        Signal { name: name.to_owned(), bits, direction }
    }

    fn expected() -> Vec<Signal> {
        vec![
            signal("clk_i", 1, Direction::Input),
            signal("x_i", 11, Direction::Input),
            signal("x_o", 25, Direction::Output),
            signal("wide_o", 80, Direction::Output),
        ]
    }

    #[test]
    fn equal_ports_pass() {
        assert_eq!(check("m", &expected(), HEADER), Ok(()));
    }

    #[test]
    fn every_difference_is_named() {
        let message = |change: fn(&mut Vec<Signal>)| {
            let mut ports = expected();
            change(&mut ports);
            check("m", &ports, HEADER).unwrap_err().to_string()
        };
        let missing = message(|p| p[1].name = "y_i".to_owned());
        assert_eq!(missing, "module m has no port y_i; its interface has one of 11 bits");
        let width = message(|p| p[1].bits = 12);
        assert_eq!(width, "port x_i of module m has 11 bits, its interface says 12");
        let direction = message(|p| p[2].direction = Direction::Input);
        assert_eq!(direction, "port x_o of module m has the wrong direction");
        let unknown = message(|p| drop(p.pop()));
        assert_eq!(unknown, "module m has a port wide_o of 80 bits that its interface lacks");
    }
}
