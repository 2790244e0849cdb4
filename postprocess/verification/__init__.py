"""Pictures of the verification page.

plots - pictures of the verification page
"""
