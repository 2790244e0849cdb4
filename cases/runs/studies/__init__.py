"""Answers on a case that need no film solved anew.

| module | responsibility |
|---|---|
| atlas | films of the film atlas, of a contact or of a bearing |
| stiffness | stiffness over speed |
| supply | torque at other supplies of oil, films after the supply stops |
"""
