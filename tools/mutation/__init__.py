"""Single wrong signs, factors, arguments and terms in the product, and the tests that execute them."""
