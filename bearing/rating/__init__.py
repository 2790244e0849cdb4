"""Rating life, load ratings and defect frequencies."""
