//! Small charts laid back on their neighbors along common borders, where they find room.

mod alike;
pub(super) mod border;
mod cost;
pub(super) mod given_back;
mod joint;
mod laid;
pub(super) mod occupied;
