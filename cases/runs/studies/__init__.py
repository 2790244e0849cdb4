"""Further answers on a case.

| module | responsibility |
|---|---|
| atlas | films of the film atlas, of a contact or of a bearing |
| stiffness | stiffness over speed |
| temperatures | temperatures over the speed up to the limit, and over time |
| transient | a contact over time, its steps kept while it runs |
| vibration | vibration of a bearing |
| kept_steps | the folder of these steps |
| supply | torque at other supplies of oil, films after the supply stops |
"""
