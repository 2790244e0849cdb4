"""The bodies: elastic deflection, coatings, heat conduction, stress below the contact."""
