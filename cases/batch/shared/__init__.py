"""Contacts and traction tables that points share.

| module | responsibility |
|---|---|
| kept | things that took long to compute, a file each |
| contact_cache | solved contacts shared by points |
| tables | traction tables shared by points |
| table_films | films of a table that is not complete yet |

contact_cache - solved contacts on disk, named after all they depend on
kept          - things that took long to compute, a file each, named after all that they depend on
table_films   - films of a traction table on disk while it grows, so that an interrupted one goes
                on
tables        - traction tables that points of a batch share
"""
