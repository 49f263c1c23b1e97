//! Small charts laid back on their neighbors along common borders, where they find room.

mod border;
pub(super) mod given_back;
mod laid;
mod occupied;
