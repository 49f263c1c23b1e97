//! One check of derivatives for every density, barrier and objective.
