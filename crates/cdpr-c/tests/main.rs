//! The C interface: the same digits as the Rust interface, bad input, the header, and programs in C.

// Pointers are passed as from C.
#![allow(clippy::unwrap_used, clippy::panic, clippy::print_stdout, unsafe_code)]

mod bad_input;
mod c_programs;
mod common;
mod header;
mod numbers;
mod observer;
