"""Whatever takes more than one exchange: pursuits, homing, driving, and whatever else yields steps."""
