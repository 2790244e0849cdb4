"""Results of a stiffness study."""
