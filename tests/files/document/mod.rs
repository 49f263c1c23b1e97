//! glTF read and written.
mod invalid;
mod moved;
mod roundtrip;
mod survive;
mod texcoord;
mod validator;
