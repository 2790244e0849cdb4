"""Results of a shaft on bearings."""
