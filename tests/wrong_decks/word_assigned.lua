material.elastic = nil
