#!/usr/bin/env python3
"""Panels that bend far, by a continuation and by CalculiX: far.py PROGRAM continue SHEET START_DEG SUM_MM...
far.py PROGRAM ccx SHEET DEG

`continue` follows the equilibrium from START_DEG down to these sums of length times fold angle, in steps of 6 % with second
derivatives by differences; printed are sum, energy, moment and the least eigenvalue over the largest, the sum held. `ccx`
runs static.py's deck with springs that are stretched little by little: each ends at a node that is moved along it.
"""
import json
import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import plate
import static

HERE = Path(__file__).resolve().parent
CASES = {"bent-jump-4x4": (0.2, 50), "turned-wide-4x4": (0.2, 50), "bent-jump-8x6": (1, 500)}  # mm, N/mm

E, NU = 70e3, 0.33
class Sheet:
    def __init__(self, pattern, deck, t, k):
        """flat vertices from the pattern's numbers, panels and the folded shape from the deck"""
        self.t,self.k=t,k
        m,n=pattern["rows"],pattern["columns"]; w,h,o=pattern["panel_width_mm"],pattern["panel_height_mm"],pattern["zigzag_offset_mm"]
        flat=np.array([[w*j+(o if i%2 and 0<j<n else 0)+(o if j==n else 0), h*i] for i in range(m+1) for j in range(n+1)],float)
        for name,d in pattern["displacements_mm"].items(): flat[int(name[1:])-1]+=d
        self.flat=flat
        # which vertex a deck node is: panels in the deck's order are facets in the program's order
        order={}
        kept=[(r,c) for r in range(m) for c in range(n) if not (0<r<m-1 and 0<c<n-1 and (r+c)%2)]
        assert len(kept)==len(deck.panels)
        self.panels=[]; 
        for (r,c),nodes in zip(kept,deck.panels):
            v=[r*(n+1)+c, r*(n+1)+c+1, (r+1)*(n+1)+c+1,(r+1)*(n+1)+c]
            p=np.array([deck.at[x] for x in nodes]); f=flat[v]
            # a rotation of the four that fits distances
            dist=lambda q:np.linalg.norm(q-np.roll(q,-1,0),axis=1)
            best=min(range(4),key=lambda s:abs(dist(np.roll(p,-s,0))-dist(f)).max())
            for x,y in zip(v,np.roll(nodes,-best)):
                order.setdefault(x,deck.at[int(y)]); assert np.linalg.norm(order[x]-deck.at[int(y)])<1e-4
            self.panels.append(v)
        self.panels=np.array(self.panels)
        self.folded=np.array([order[x] for x in range(len(flat))])
        holes=[(r,c) for r in range(m) for c in range(n) if (r,c) not in kept]
        self.diag=np.array([d for r,c in holes for d in ((r*(n+1)+c+1,(r+1)*(n+1)+c),((r+1)*(n+1)+c+1,r*(n+1)+c))])
        self.L0=np.linalg.norm(flat[self.diag[:,0]]-flat[self.diag[:,1]],axis=1)
        edges={}
        for f,v in enumerate(self.panels):
            for i in range(4): edges.setdefault(tuple(sorted((v[i],v[(i+1)%4]))),[]).append(f)
        self.folds=[(f[0],f[1],np.linalg.norm(flat[a]-flat[b])) for (a,b),f in edges.items() if len(f)==2]
        self.fa=np.array([f[0] for f in self.folds]);self.fb=np.array([f[1] for f in self.folds]);self.fl=np.array([f[2] for f in self.folds])
        D=E*t**3/12/(1-NU**2)
        self.K=[];self.area=[];self.mu=[]
        for v in self.panels:
            c=flat[v]; st=[len(edges[tuple(sorted((v[i],v[(i+1)%4])))])==2 for i in range(4)]
            q,_,ar=plate.solve(c,st,NU,DEG)
            per=sum(np.linalg.norm(c[i]-c[(i+1)%4]) for i in range(4))
            self.K.append(D*q/(1+.315*t*per/ar)); self.area.append(ar); self.mu.append(E*t*plate.volume_clamped(c,2)/ar**4)
        self.K,self.area,self.mu=map(np.array,(self.K,self.area,self.mu))
        self.bars=[(0,1),(1,2),(2,3),(3,0),(0,2),(1,3)]
        F=flat[self.panels]
        self.l2=np.array([((F[:,a]-F[:,b])**2).sum(1) for a,b in self.bars]).T
        side=self.l2[:,:4]
        self.kside=.12*E*t*self.area[:,None]/side
        self.cot=(self.l2[:,4]-self.l2[:,5])/4/self.area
        self.shear=np.concatenate([(self.cot/4)[:,None]/side, -1/(4*self.area)[:,None], 1/(4*self.area)[:,None]],1)
        self.kshear=E*t/2/(1+NU)*self.area
        # support: three vertices of panel 0
        a,b,_,d=self.panels[0]; u=self.folded[b]-self.folded[a]; nn=np.cross(u,self.folded[d]-self.folded[a])
        fr=int(np.argmax(abs(u))); ac=int(np.argmax(abs(nn)))
        held={3*a,3*a+1,3*a+2,3*d+ac}|{3*b+c for c in range(3) if c!=fr}
        self.free=np.array([i for i in range(3*len(flat)) if i not in held])
    def grad(self,X,L0):
        """energies and gradients of many shapes at once: X (.., v, 3)"""
        G=np.zeros_like(X); p=X[:,self.panels]
        d=[p[:,:,a]-p[:,:,b] for a,b in self.bars]
        sq=np.stack([(x*x).sum(-1) for x in d],-1)-self.l2
        e=np.zeros(X.shape[0])
        strain=sq[...,:4]/(2*np.sqrt(self.l2[:,:4])); e+=(self.kside*strain**2).sum((1,2))/2
        coef=np.zeros_like(sq); coef[...,:4]=self.kside*strain/(2*np.sqrt(self.l2[:,:4]))
        sh=(self.shear*sq).sum(-1); e+=(self.kshear*sh**2).sum(1)/2
        coef+=(self.kshear*sh)[...,None]*self.shear
        a,b,c=p[:,:,1]-p[:,:,0],p[:,:,2]-p[:,:,0],p[:,:,3]-p[:,:,0]
        q=(a*np.cross(b,c)).sum(-1)/self.area
        e+=(self.K*q*q/2+self.mu*q**4/2).sum(1); dq=(self.K*q+2*self.mu*q**3)/self.area
        gp=np.zeros_like(p)
        ga,gb,gc=np.cross(b,c)*dq[...,None],np.cross(c,a)*dq[...,None],np.cross(a,b)*dq[...,None]
        gp[:,:,1]+=ga;gp[:,:,2]+=gb;gp[:,:,3]+=gc;gp[:,:,0]-=ga+gb+gc
        for i,(x,y) in enumerate(self.bars):
            g=2*coef[...,i,None]*d[i]; gp[:,:,x]+=g; gp[:,:,y]-=g
        for i in range(4): 
            for f in range(len(self.panels)): G[:,self.panels[f,i]]+=gp[:,f,i]
        v=X[:,self.diag[:,0]]-X[:,self.diag[:,1]]; l=np.linalg.norm(v,axis=-1); pull=l-L0
        e+=self.k/2*(pull**2).sum(1); g=self.k*(pull/l)[...,None]*v
        for i,(x,y) in enumerate(self.diag): G[:,x]+=g[:,i];G[:,y]-=g[:,i]
        return e,G.reshape(len(X),-1)
    def turned(self,X):
        p=X[:,self.panels]; one=p[:,:,2]-p[:,:,0]; oth=p[:,:,3]-p[:,:,1]; n=np.cross(one,oth)
        na,nb=n[:,self.fa],n[:,self.fb]; cr=np.cross(na,nb); s=np.linalg.norm(cr,axis=-1); c=(na*nb).sum(-1)
        S=(self.fl*np.arctan2(s,c)).sum(1)
        ax=cr/s[...,None]; gn=np.zeros_like(n)
        ga=-np.cross(ax,na)/(na*na).sum(-1)[...,None]*self.fl[:,None]; gb=np.cross(ax,nb)/(nb*nb).sum(-1)[...,None]*self.fl[:,None]
        for i in range(len(self.fl)): gn[:,self.fa[i]]+=ga[:,i]; gn[:,self.fb[i]]+=gb[:,i]
        g1=np.cross(oth,gn); g2=np.cross(gn,one); G=np.zeros_like(X)
        for f,v in enumerate(self.panels):
            G[:,v[0]]-=g1[:,f];G[:,v[2]]+=g1[:,f];G[:,v[1]]-=g2[:,f];G[:,v[3]]+=g2[:,f]
        return S,G.reshape(len(X),-1)
    def lagr(self,X,m,L0):
        e,g=self.grad(X,L0); S,h=self.turned(X)
        return e,S,(g-np.reshape(m,(-1,1))*h)[:,self.free],h[:,self.free]
    def hess(self,x,m,L0,h=2e-4):
        n=len(self.free); X=np.repeat(x[None],2*n,0).reshape(2*n,-1)
        X[np.arange(n),self.free]+=h; X[n+np.arange(n),self.free]-=h
        _,_,g,_=self.lagr(X.reshape(2*n,-1,3),np.full(2*n,m),L0)
        H=(g[:n]-g[n:])/(2*h); return (H+H.T)/2
    def system(self,x,m,L0):
        e,S,r,h=self.lagr(x[None],m,L0); H=self.hess(x,m,L0); n=len(self.free)
        A=np.zeros((n+1,n+1)); A[:n,:n]=H; A[:n,n]=-h[0]; A[n,:n]=h[0]
        return e[0],S[0],r[0],h[0],A
    def newton(self,x,m,S,L0,most=8,tol=1e-9):
        x=x.copy(); last=None; e=None
        for k in range(most):
            e,s,r,h,A=self.system(x,m,L0)
            d=np.linalg.solve(A,-np.append(r,s-S))
            size=abs(d[:-1]).max()
            if last is not None and size>max(last*.3,1e-7): return None
            x.reshape(-1)[self.free]+=d[:-1]; m+=d[-1]; last=size
            if size<tol: return x,m,e,A
        return None
    def stable(self,A):
        """least eigenvalue of the Hessian where the sum is held, over the largest"""
        n=len(self.free); g=A[n,:n]; q=np.linalg.qr(np.column_stack([g,np.eye(n)[:,:n-1]]))[0][:,1:]
        w=np.linalg.eigvalsh(q.T@A[:n,:n]@q); return w[0]/w[-1]
    def start(self):
        """load: springs' relaxed lengths from those of the rigid shape to the flat ones"""
        x=self.folded.copy(); m=0.; S,_=self.turned(x[None]); S=S[0]
        L1=np.linalg.norm(x[self.diag[:,0]]-x[self.diag[:,1]],axis=1); at=0.;h=.1
        x,m,e,A=self.newton(x,m,S,L1)
        while at<1:
            h=min(h,1-at)
            v=x[self.diag[:,0]]-x[self.diag[:,1]]; u=v/np.linalg.norm(v,axis=1)[:,None]
            b=np.zeros_like(x); dl=self.k*(self.L0-L1)
            for i,(p,q) in enumerate(self.diag): b[p]+=dl[i]*u[i]; b[q]-=dl[i]*u[i]
            d=np.linalg.solve(A,np.append(b.reshape(-1)[self.free],0))
            y=x.copy(); y.reshape(-1)[self.free]+=h*d[:-1]
            new=self.newton(y,m+h*d[-1],S,L1+(at+h)*(self.L0-L1))
            if new is None: h/=2; assert h>1e-4; continue
            x,m,e,A=new; at+=h; h*=1.5
        return x,m,e,S,A
    def down(self,x,m,S,A,targets):
        """follow to the sums in targets (descending), steps of at most 3 %"""
        for T in targets:
            while S>T*(1+1e-13):
                h=max(T-S,-.06*S)
                while True:
                    d=np.linalg.solve(A,np.append(np.zeros(len(self.free)),1.))
                    y=x.copy(); y.reshape(-1)[self.free]+=h*d[:-1]
                    new=self.newton(y,m+h*d[-1],S+h,self.L0)
                    if new: break
                    h/=2
                    if abs(h)<1e-5*S: print("lost at",S); return
                S+=h; x,m,e,A=new
            yield T,e,m,self.stable(A),x
DEG=5
def run(path,t,k,start,sums,program):
    with tempfile.TemporaryDirectory() as d:
        subprocess.run([program,"export",path,"--format","inp","--from",str(start),"--mesh","2","--preload","0","--thickness",str(t),"--stiffness",str(k),"--output",d],check=True,capture_output=True)
        deck=static.Deck((Path(d)/f"{Path(path).stem}.inp").read_text())
    s=Sheet(json.loads(Path(path).read_text()),deck,t,k)
    x,m,e,S,A=s.start()
    yield S,e,m,s.stable(A),x
    yield from s.down(x,m,S,A,sorted((a for a in sums if a<S),reverse=True))


def ramped(deck):
    head=re.sub(r"\*ELEMENT, TYPE=SPRINGA.*\n.*\n\*SPRING.*\n\n.*\n.*\n","",deck.head)
    deck.head=head
    text=deck.static()
    i=text.index("*BOUNDARY\n"); j=text.index("*STEP, NLGEOM"); 
    nodes=max(deck.at)+1; el=100000
    extra="";ref=nodes+1000
    extra+=f"*NODE, NSET=NREF\n{ref},0.,0.,0.\n"
    for m,(a,b,k,start) in enumerate(deck.springs):
        d=nodes+m; e=deck.at[b]-deck.at[a]; e/=np.linalg.norm(e)
        p=deck.at[b]
        extra+=f"*NODE\n{d},{p[0]!r},{p[1]!r},{p[2]!r}\n"
        for c in range(3):
            if abs(e[c]*start)>1e-12: extra+=f"*EQUATION\n3\n{d},{c+1},1.,{b},{c+1},-1.,{ref},1,{-e[c]*start:.11e}\n"
            else: extra+=f"*EQUATION\n2\n{d},{c+1},1.,{b},{c+1},-1.\n"
        extra+=f"*ELEMENT, TYPE=SPRINGA, ELSET=R{m}\n{el+m},{a},{d}\n*SPRING, NONLINEAR, ELSET=R{m}\n\n{-k*100!r},-100.\n{k*100!r},100.\n"
    bound=text[i:j].replace("*BOUNDARY\n",f"*BOUNDARY\n{ref},2,3\n")
    tail=text[j:]
    tail=re.sub(r"\*STATIC\n.*\n",f"*STATIC\n0.02,1.,1e-6,0.1\n*BOUNDARY\n{ref},1,1,1.\n",tail)
    tail=re.sub(r"\*CONTROLS.*\n.*\n","",tail)
    return text[:i]+extra+bound+tail


def ccx(program, sheet, deg):
    t, k = CASES[sheet]
    with tempfile.TemporaryDirectory() as folder:
        work = Path(folder)
        subprocess.run([program, "export", HERE / "far" / f"{sheet}.json", "--format", "inp", "--from", deg, "--mesh", "4", "--thickness",
                        str(t), "--stiffness", str(k), "--preload", "0", "--output", work], check=True, capture_output=True)
        deck = static.Deck((work / f"{sheet}.inp").read_text(), 0)
        (work / "static.inp").write_text(ramped(deck))
        subprocess.run(["ccx", "static"], cwd=work, env=os.environ | {"OMP_NUM_THREADS": "1"}, capture_output=True)
        blocks = re.split(r"\n displacements .* time +(\S+)\n", (work / "static.dat").read_text())
    moved = deck.still()
    for node, *u in re.findall(r"^ +(\d+) +(\S+) +(\S+) +(\S+)$", blocks[-1], re.M):
        moved[deck.node_of[int(node)]] = np.array([float(v) for v in u])
    energy = float(re.search(r"internal energy.*\n\n +(\S+)", blocks[-1])[1])
    for a, b, stiffness, start in deck.springs:  # as long as ccx has them: their moved ends keep the direction of the start
        along = deck.at[b] - deck.at[a]
        length = np.linalg.norm(along)
        end = deck.at[b] + moved[b] + along / length * start
        energy += stiffness / 2 * (np.linalg.norm(end - deck.at[a] - moved[a]) - length) ** 2
    print("load", blocks[-2], "sum", deck.turned(moved), "energy", energy)


if __name__ == "__main__":
    program, what, sheet, start, *sums = sys.argv[1:]
    if what == "ccx":
        ccx(program, sheet, start)
    else:
        for row in run(str(HERE / "far" / f"{sheet}.json"), *CASES[sheet], float(start), [float(s) for s in sums], program):
            print(*row[:4], flush=True)
