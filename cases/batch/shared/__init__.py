"""Contacts and traction tables that points share.

| module | responsibility |
|---|---|
| kept | things that took long to compute, a file each |
| contact_cache | solved contacts shared by points |
| tables | traction tables shared by points |
| table_films | films of a table that is not complete yet |
"""
