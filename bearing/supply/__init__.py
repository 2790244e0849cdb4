"""Oil supply and starved films.

starved_films - films of the contacts of a bearing that gets little oil
supply        - oil supply, first order: the film that little oil leaves
"""
