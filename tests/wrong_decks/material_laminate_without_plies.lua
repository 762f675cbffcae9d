local skin = material.laminate{ name = "skin", plies = {} }
