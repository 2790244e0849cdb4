"""Answers on a case that need no film solved.

| module | responsibility |
|---|---|
| atlas | films of the film atlas, of a contact or of a bearing |
| stiffness | stiffness over speed |
"""
